#include "renderer/gl/shader_source.h"

#include "renderer/base/error.h"
#include "renderer/base/names.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>

namespace lightsweep::gl {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

using Files = std::map<std::string, std::string>;

// All files are given as text, so these need no folder.
ShaderSource load(const Files& files, const std::vector<std::string>& defines = {}) {
    return load_shader("main.frag.glsl", defines, files);
}

std::string input_error(const Files& files) {
    try {
        load(files);
    } catch (const InputError& error) {
        return error.what();
    }
    return "no InputError";
}

size_t count(const std::string& text, const std::string& part) {
    size_t found = 0;
    for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
}

TEST(ShaderSource, BeginsWithVersionAndDefines) {
    const ShaderSource source = load({{"main.frag.glsl", "void main() {}\n"}}, {"REVERSED_DEPTH", "SAMPLES 4"});
    EXPECT_EQ(source.text,
              "#version 450 core\n"
              "#define REVERSED_DEPTH\n"
              "#define SAMPLES 4\n"
              "void main() {}\n");
    EXPECT_THAT(source.files, ElementsAre("defines of main.frag.glsl", "main.frag.glsl"));
}

// Every line of the text, with the file and the line that it came from.
std::vector<std::string> listing(const ShaderSource& source) {
    std::vector<std::string> lines = split(source.text, '\n');
    lines.pop_back();  // after the last newline
    EXPECT_EQ(lines.size(), source.origins.size());
    for (size_t i = 0; i < lines.size(); ++i)
        lines[i] =
            fmt::format("{}:{}: {}", source.files.at(source.origins.at(i).file), source.origins[i].line, lines[i]);
    return lines;
}

TEST(ShaderSource, KnowsWhereEachLineCameFrom) {
    const ShaderSource source =
        load({{"main.frag.glsl", "one\n#include \"lib/a.glsl\"\nthree\n"}, {"lib/a.glsl", "first\n\nthird"}},
             {"ONE", "TWO 2"});
    EXPECT_THAT(
        listing(source),
        ElementsAre("defines of main.frag.glsl:1: #version 450 core", "defines of main.frag.glsl:2: #define ONE",
                    "defines of main.frag.glsl:3: #define TWO 2", "main.frag.glsl:1: one", "lib/a.glsl:1: first",
                    "lib/a.glsl:2: ", "lib/a.glsl:3: third", "main.frag.glsl:3: three"));
}

TEST(ShaderSource, IncludesAreRelativeToTheFolderNotToTheFile) {
    EXPECT_THAT(load({{"main.frag.glsl", "#include \"lib/a.glsl\"\n"},
                      {"lib/a.glsl", "#include \"lib/b.glsl\"\n"},
                      {"lib/b.glsl", "from_b\n"}})
                    .text,
                HasSubstr("from_b"));
    EXPECT_THAT(input_error({{"main.frag.glsl", "#include \"lib/a.glsl\"\n"},
                             {"lib/a.glsl", "#include \"b.glsl\"\n"},
                             {"lib/b.glsl", "from_b\n"}}),
                HasSubstr("lib/a.glsl:1: "));
}

TEST(ShaderSource, EachFileComesOnceHoweverItIsSpelt) {
    const ShaderSource source =
        load({{"main.frag.glsl",
               "#include \"lib/a.glsl\"\n#include \"lib/b.glsl\"\n#include \"./lib/../lib/a.glsl\"\nend\n"},
              {"lib/a.glsl", "only_once\n"},
              {"lib/b.glsl", "#include \"lib/a.glsl\"\n"}});
    EXPECT_EQ(count(source.text, "only_once"), 1u);
    EXPECT_THAT(source.text, HasSubstr("only_once\nend\n"));
}

TEST(ShaderSource, ACycleEnds) {
    const ShaderSource source = load({{"main.frag.glsl", "#include \"a.glsl\"\nmain\n"},
                                      {"a.glsl", "#include \"b.glsl\"\nafter_b\n"},
                                      {"b.glsl", "#include \"a.glsl\"\n#include \"main.frag.glsl\"\nafter_a\n"}});
    EXPECT_LT(source.text.find("after_a"), source.text.find("after_b"));
    EXPECT_EQ(source.files.size(), 4u);
}

TEST(ShaderSource, CommentsAreLeftOutAndTheirIncludesWithThem) {
    const ShaderSource source = load({{"main.frag.glsl",
                                       "// #include \"missing.glsl\"\n"
                                       "before/* #include \"missing.glsl\"\n"
                                       "#include \"missing.glsl\"\n"
                                       "*/ /* */ # include \"a.glsl\" // why /*\n"
                                       "a / b * c // d\n"},
                                      {"a.glsl", "from_a\n"}});
    EXPECT_EQ(source.text, "#version 450 core\n\nbefore \n\nfrom_a\na / b * c \n");
}

TEST(ShaderSource, AMissingIncludeNamesTheIncludingLineAndTheNearestFile) {
    EXPECT_THAT(
        input_error({{"main.frag.glsl", "\n\n#include \"generated/gbufer.glsl\"\n"}, {"generated/gbuffer.glsl", ""}}),
        AllOf(HasSubstr("main.frag.glsl:3: "), HasSubstr("'generated/gbufer.glsl'"),
              HasSubstr("did you mean 'generated/gbuffer.glsl'?")));
}

TEST(ShaderSource, AMissingStageFileIsNamed) { EXPECT_THAT(input_error({}), HasSubstr("shaders/main.frag.glsl: ")); }

TEST(ShaderSource, RefusesWhatItCannotMean) {
    EXPECT_THAT(input_error({{"main.frag.glsl", "#include <a.glsl>\n"}}), HasSubstr("main.frag.glsl:1: malformed"));
    EXPECT_THAT(input_error({{"main.frag.glsl", "#include \"../a.glsl\"\n"}}), HasSubstr("main.frag.glsl:1: "));
    EXPECT_THAT(input_error({{"main.frag.glsl", "#include \"/etc/passwd\"\n"}}), HasSubstr("main.frag.glsl:1: "));
    EXPECT_THAT(input_error({{"main.frag.glsl", "\n#version 330\n"}}), HasSubstr("main.frag.glsl:2: #version"));
    EXPECT_THAT(input_error({{"main.frag.glsl", "#line 7\n"}}), HasSubstr("main.frag.glsl:1: #line"));
}

TEST(ShaderSource, AHeaderSharedWithCppKeepsItsOwnIncludes) {
    const ShaderSource source =
        load({{"main.frag.glsl", "#include \"types.h\"\n"},
              {"types.h", "#ifdef __cplusplus\n#include <glm/glm.hpp>\n#endif\nstruct Light { vec4 color; };\n"}});
    EXPECT_EQ(count(source.text, "glm"), 0u);
    EXPECT_EQ(count(source.text, "struct Light"), 1u);
}

// The loader does not evaluate conditions: where the first include stands under an #if that is false, leaving the
// second one out would lose the text.
TEST(ShaderSource, RefusesAnIncludeThatAConditionMayHaveSwallowed) {
    const Files files = {{"main.frag.glsl", "#ifdef X\n#include \"a.glsl\"\n#endif\n#include \"a.glsl\"\n"},
                         {"a.glsl", "a\n"}};
    EXPECT_THAT(input_error(files), HasSubstr("main.frag.glsl:4: 'a.glsl' was included under an #if"));
    EXPECT_EQ(count(load({{"main.frag.glsl", "#include \"a.glsl\"\n#if X\n#include \"a.glsl\"\n#endif\n"},
                          {"a.glsl", "from_a\n"}})
                        .text,
                    "from_a"),
              1u);
}

TEST(ShaderSource, ReadsFilesOfAFolderAndGeneratedTextGoesAhead) {
    const std::filesystem::path root = std::filesystem::path(testing::TempDir()) / "shader_source_test" / "shaders";
    std::filesystem::create_directories(root / "lib");
    std::ofstream(root / "x.comp.glsl") << "#include \"lib/a.glsl\"\n#include \"lib/b.glsl\"\n";
    std::ofstream(root / "lib/a.glsl") << "a_on_disk";
    std::ofstream(root / "lib/b.glsl") << "b_on_disk\n";
    const ShaderSource source = load_shader("x.comp.glsl", {}, {{"lib/b.glsl", "b_generated\n"}}, root);
    EXPECT_THAT(source.text, HasSubstr("a_on_disk\nb_generated\n"));
    EXPECT_EQ(count(source.text, "b_on_disk"), 0u);
    EXPECT_THAT(source.files, ElementsAre("defines of shaders/x.comp.glsl", "shaders/x.comp.glsl", "shaders/lib/a.glsl",
                                          "lib/b.glsl"));
    std::filesystem::remove_all(root.parent_path());
}

const ShaderSource kThreeLines{"", {"defines", "shaders/x.frag.glsl", "shaders/lib/y.glsl"}, {{0, 1}, {1, 12}, {2, 7}}};

TEST(MapLog, NamesTheFileInEveryDriversForm) {
    EXPECT_EQ(map_log("0:2(5): error: `a' undeclared\n0:3(1): warning: unused\n", kThreeLines),
              "shaders/x.frag.glsl:12:5: error: `a' undeclared\nshaders/lib/y.glsl:7:1: warning: unused\n");
    EXPECT_EQ(map_log("0(3) : error C1503: undefined variable \"a\"\n", kThreeLines),
              "shaders/lib/y.glsl:7: error C1503: undefined variable \"a\"\n");
    EXPECT_EQ(map_log("ERROR: 0:2: 'a' : undeclared identifier\n", kThreeLines),
              "shaders/x.frag.glsl:12: ERROR: 'a' : undeclared identifier\n");
}

TEST(MapLog, LeavesTheRestAlone) {
    for (const std::string line : {"error: vertex shader output `a' not read\n", "0:4(5): error: no such line\n",
                                   "0:0(5): error: no such line\n", "1:2(5): error: no such source\n",
                                   "0:99999999999999999999(1): error: too many digits\n", "\n"})
        EXPECT_EQ(map_log(line, kThreeLines), line);
    EXPECT_EQ(map_log("", kThreeLines), "");
}

}  // namespace
}  // namespace lightsweep::gl

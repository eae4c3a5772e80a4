#include "renderer/gl/shader_source.h"

#include "renderer/base/check.h"
#include "renderer/base/error.h"
#include "renderer/base/file.h"
#include "renderer/base/names.h"

#include <fmt/format.h>

#include <charconv>
#include <regex>
#include <sstream>

namespace lightsweep::gl {
namespace {

// The line without its comments; `in_comment` says whether a block comment is open before it, and after it.
std::string without_comments(std::string_view line, bool& in_comment) {
    std::string code;
    for (size_t i = 0; i < line.size(); ++i) {
        const std::string_view two = line.substr(i, 2);
        if (in_comment ? two == "*/" : two == "/*") {
            in_comment = !in_comment;
            code += ' ';
            ++i;
        } else if (!in_comment) {
            if (two == "//") break;
            code += line[i];
        }
    }
    return code;
}

struct Directive {
    std::string name;      // "include", or empty when the line is no directive
    std::string argument;  // the rest, trimmed
};

Directive parse_directive(const std::string& code) {
    static const std::regex kDirective(R"(\s*#\s*(\w+)\s*(.*?)\s*)");
    std::smatch match;
    if (code.find('#') == std::string::npos || !std::regex_match(code, match, kDirective)) return {};
    return {match[1], match[2]};
}

class Assembler {
  public:
    Assembler(const std::map<std::string, std::string>& generated, const std::filesystem::path& root)
        : generated_(generated), root_(root) {}

    ShaderSource assemble(std::string_view name, std::span<const std::string> defines) {
        const std::string stage = shown(std::string(name));
        source_.files.push_back("defines of " + stage);
        append("#version 450 core", {0, 1});
        for (const std::string& define : defines) {
            CHECK_THAT(define.find('\n') == std::string::npos, "define '{}'", define);
            append("#define " + define, {0, source_.origins.size() + 1});
        }
        add(std::string(name), stage);
        return std::move(source_);
    }

  private:
    void append(const std::string& line, LineOrigin origin) {
        source_.text += line + "\n";
        source_.origins.push_back(origin);
    }

    // The name in messages: a generated text's key, or the path with the folder's own name in front.
    std::string shown(const std::string& file) const {
        return generated_.contains(file) ? file : (root_.filename() / file).generic_string();
    }

    // `where` is blamed when the file is missing.
    std::string read(const std::string& file, const std::string& where) const {
        if (const auto found = generated_.find(file); found != generated_.end()) return found->second;
        if (std::filesystem::is_regular_file(root_ / file)) return read_file(root_ / file);
        std::vector<std::string> known;
        for (const auto& [key, text] : generated_) known.push_back(key);
        std::error_code no_folder;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(root_, no_folder))
            if (entry.path().extension() == ".glsl")
                known.push_back(entry.path().lexically_relative(root_).generic_string());
        const std::string nearest = nearest_name(file, known);
        throw InputError(where, fmt::format("no file '{}' in {}{}", file, root_.generic_string(),
                                            nearest.empty() ? "" : fmt::format(" (did you mean '{}'?)", nearest)));
    }

    void add(const std::string& file, const std::string& where) {
        const std::string text = read(file, where);
        const std::string name = shown(file);
        const size_t number = source_.files.size();
        source_.files.push_back(name);
        in_condition_[file] = condition_depth_ > 0;

        std::istringstream lines(text);
        bool in_comment = false;
        std::string line;
        for (size_t line_number = 1; std::getline(lines, line); ++line_number) {
            const std::string code = without_comments(line, in_comment);
            const Directive directive = parse_directive(code);
            const std::string place = fmt::format("{}:{}", name, line_number);
            if (directive.name == "include") {
                include(directive.argument, place);
                continue;
            }
            if (directive.name == "version" || directive.name == "line")
                throw InputError(place,
                                 fmt::format("#{} is not allowed: the loader counts on its own", directive.name));
            if (directive.name.starts_with("if")) ++condition_depth_;
            if (directive.name == "endif") --condition_depth_;
            append(code, {number, line_number});
        }
    }

    void include(const std::string& argument, const std::string& place) {
        // Headers shared with C++ include the standard's and libraries' under #ifdef __cplusplus.
        if (argument.starts_with('<') && condition_depth_ > 0) return;
        static const std::regex kQuoted(R"re("([^"]+)")re");
        std::smatch match;
        if (!std::regex_match(argument, match, kQuoted))
            throw InputError(place,
                             fmt::format("malformed #include {}; allowed: #include \"folder/file.glsl\"", argument));
        const std::filesystem::path path = std::filesystem::path(match[1].str()).lexically_normal();
        if (path.is_absolute() || *path.begin() == "..")
            throw InputError(place, fmt::format("#include \"{}\" leaves {}", match[1].str(), root_.generic_string()));
        const std::string file = path.generic_string();
        const auto seen = in_condition_.find(file);
        if (seen == in_condition_.end()) return add(file, place);
        if (seen->second)
            throw InputError(place,
                             fmt::format("'{}' was included under an #if before and may be missing here; include "
                                         "it ahead of the #if",
                                         file));
    }

    const std::map<std::string, std::string>& generated_;
    const std::filesystem::path& root_;
    ShaderSource source_;
    std::map<std::string, bool> in_condition_;  // every file met so far, and whether it came in under an #if
    int condition_depth_ = 0;
};

// 0 when it is too large.
size_t parse_number(const std::string& digits) {
    size_t number = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), number);
    return number;
}

}  // namespace

ShaderSource load_shader(std::string_view name, std::span<const std::string> defines,
                         const std::map<std::string, std::string>& generated, const std::filesystem::path& root) {
    return Assembler(generated, root).assemble(name, defines);
}

std::string map_log(const std::string& log, const ShaderSource& source) {
    // In every form the first group is the line; `rest` is what else is kept.
    static const struct {
        std::regex pattern;
        const char* rest;
    } kForms[] = {
        {std::regex(R"(0:(\d+)\((\d+)\): )"), "$2: "},                     // Mesa    0:12(5): error: ...
        {std::regex(R"(0\((\d+)\) : )"), " "},                             // NVIDIA  0(12) : error C1008: ...
        {std::regex(R"((?=[A-Z]+: 0:(\d+): )([A-Z]+: )0:\d+: )"), " $2"},  // others  ERROR: 0:12: ...
    };
    std::string mapped;
    std::istringstream lines(log);
    for (std::string line; std::getline(lines, line);) {
        for (const auto& form : kForms) {
            std::smatch match;
            if (!std::regex_search(line, match, form.pattern, std::regex_constants::match_continuous)) continue;
            const size_t number = parse_number(match[1]);
            if (number == 0 || number > source.origins.size()) break;
            const LineOrigin origin = source.origins[number - 1];
            line = fmt::format("{}:{}:{}{}", source.files[origin.file], origin.line, match.format(form.rest),
                               match.suffix().str());
            break;
        }
        mapped += line + "\n";
    }
    return mapped;
}

}  // namespace lightsweep::gl

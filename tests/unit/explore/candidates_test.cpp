// What must hold for layouts that are put together from options: nothing overlaps, nothing is lost, files read back.
#include "bench/explore/candidates.h"

#include "renderer/base/error.h"
#include "renderer/base/file.h"
#include "renderer/base/resources.h"
#include "renderer/gbuffer/layout_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

namespace lightsweep {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

FieldOption option(Field field, const std::string& encoding, std::vector<int> bits) {
    return {.field = field, .encoding = load_encoding(encoding), .bits = std::move(bits)};
}

std::vector<FieldOption> thin() {
    return {option(Field::normal, "oct", {12, 12}), option(Field::base_color, "gamma2", {5, 6, 5}),
            option(Field::roughness, "linear", {8}), option(Field::metallic, "linear", {4}),
            option(Field::model, "id", {2})};
}

std::filesystem::path written(const std::string& name, const std::string& text) {
    const auto file = std::filesystem::path(testing::TempDir()) / name;
    write_file_atomically(file, text);
    return file;
}

TEST(Pack, EveryBitIsTakenOnce) {
    const auto fields = thin();
    const Layout layout = pack("thin", fields, {});
    std::set<std::tuple<size_t, int, int>> taken;
    size_t bits = 0;
    for (size_t t = 0; t < layout.targets.size(); ++t) {
        for (const auto& stored : layout.targets[t].fields) {
            for (const Slot& slot : stored.slots) {
                EXPECT_LT(slot.component, gl::info(layout.targets[t].format).components);
                for (int b = slot.low_bit; b < slot.low_bit + slot.bit_count; ++b) {
                    EXPECT_LT(b, 32);
                    EXPECT_TRUE(taken.emplace(t, slot.component, b).second) << "a bit twice";
                    ++bits;
                }
            }
        }
    }
    EXPECT_EQ(bits, 24U + 16U + 8U + 4U + 2U);
    EXPECT_EQ(layout.bytes_per_pixel(), 8 + 4) << "54 bits in two words, beside a depth of four bytes";
}

TEST(Pack, TargetsFollowTheNumberOfWords) {
    const auto word = [](Field field) { return option(field, "rgb9e5", {32}); };
    const std::vector<FieldOption> fields = {word(Field::emissive), option(Field::normal, "oct", {16, 16}),
                                             option(Field::base_color, "gamma2", {10, 10, 10}),
                                             option(Field::specular, "gamma2", {10, 10, 10}),
                                             option(Field::roughness, "linear", {8})};
    const std::vector<std::vector<std::string_view>> formats = {
        {}, {"R32UI"}, {"RG32UI"}, {"RG32UI", "R32UI"}, {"RGBA32UI"}, {"RGBA32UI", "R32UI"}};
    for (size_t n = 1; n <= fields.size(); ++n) {
        const Layout layout = pack("x", std::span(fields).first(n), {});
        std::vector<std::string_view> names;
        for (const auto& target : layout.targets) names.push_back(gl::info(target.format).name);
        EXPECT_EQ(names, formats[n]) << n << " words";
    }
}

TEST(Pack, ItsFileReadsBack) {
    const Layout layout =
        pack("round_trip", thin(), {.format = gl::Format::D24, .convention = DepthConvention::standard});
    const Layout back = load_layout(written("round_trip.json", layout_json(layout)).string());
    EXPECT_EQ(layout_json(back), layout_json(layout));
    EXPECT_EQ(back.key, layout.key);
    EXPECT_EQ(back.convention, DepthConvention::standard);
    for (const auto& key : layout_keys()) {
        const Layout shipped = load_layout(key);
        EXPECT_EQ(layout_json(load_layout(written(key + ".json", layout_json(shipped)).string())),
                  layout_json(shipped));
    }
}

TEST(WithOption, ChangesOneFieldAlone) {
    const Layout control = load_layout("float32");
    const FieldOption packed = option(Field::normal, "oct", {8, 8});
    const Layout layout = with_option(control, packed);
    for (const auto& target : layout.targets) {
        for (const auto& stored : target.fields) {
            EXPECT_EQ(stored.encoding.key == "oct", stored.field == Field::normal);
        }
    }
    for (const Field field : {Field::position, Field::base_color, Field::roughness, Field::emissive})
        EXPECT_TRUE(layout.stores(field));
}

TEST(Undominated, KeepsWhatNothingBeats) {
    const auto front =
        undominated({{0, 16, 0.3}, {1, 24, 0.1}, {2, 24, 0.2}, {3, 12, 0.3}, {4, 32, 0.1}, {5, 30, 0.05}});
    std::vector<size_t> indices;
    for (const auto& o : front) indices.push_back(o.index);
    EXPECT_EQ(indices, (std::vector<size_t>{3, 1, 5}));
}

TEST(Options, TheShippedOnesLoad) {
    const Options options = load_options(resource("bench/explore/options.json").string());
    EXPECT_FALSE(options.depths.empty());
    for (const auto& [field, list] : options.fields) {
        for (const auto& o : list) {
            EXPECT_EQ(o.field, field);
            EXPECT_LE(o.total_bits(), 32);
        }
    }
}

TEST(Options, MistakesNameThePlace) {
    const auto load = [](const std::string& text) { return load_options(written("options.json", text).string()); };
    const std::string depth = R"("depth": [{"format": "D24", "convention": "standard"}])";
    EXPECT_THAT([&] { load(R"({"normal": [{"encoding": "otc", "bits": [8, 8]}], )" + depth + "}"); },
                ThrowsMessage<InputError>(HasSubstr("/normal/0/encoding")));
    EXPECT_THAT([&] { load(R"({"normal": [{"encoding": "oct", "bits": [8]}], )" + depth + "}"); },
                ThrowsMessage<InputError>(HasSubstr("2 channels")));
    EXPECT_THAT([&] { load(R"({"position": [{"encoding": "position", "bits": [8, 8, 8]}], )" + depth + "}"); },
                ThrowsMessage<InputError>(HasSubstr("position")));
    EXPECT_THAT([&] { load(R"({"normal": [{"encoding": "oct", "bits": [20, 20]}], )" + depth + "}"); },
                ThrowsMessage<InputError>(HasSubstr("32 bits")));
    EXPECT_THAT([&] { load(R"({"normal": [{"encoding": "oct", "bits": [8, 8]}]})"); },
                ThrowsMessage<InputError>(HasSubstr("depth")));
}

}  // namespace
}  // namespace lightsweep

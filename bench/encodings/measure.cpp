#include "bench/encodings/measure.h"

#include "bench/encodings/round_trip.h"
#include "bench/stats/schedule.h"
#include "renderer/base/check.h"

#include <algorithm>
#include <chrono>
#include <map>

namespace lightsweep {
namespace {

constexpr size_t kPixels = size_t{kSampleColumns} * kSampleRows;

double timed_ns_per_px(const auto& issue) {
    gl::finish();
    const auto start = std::chrono::steady_clock::now();
    issue();
    gl::finish();
    const std::chrono::duration<double, std::nano> taken = std::chrono::steady_clock::now() - start;
    return taken.count() / static_cast<double>(kPixels);
}

// The variants of one field, all on the GPU at once.
class FieldRun {
  public:
    explicit FieldRun(std::vector<const Variant*> variants)
        : variants_(std::move(variants)), output_(make_float_texture(kSampleColumns, kSampleRows, "decoded")) {
        const gl::Texture* const color = &output_;
        decoded_ = gl::Framebuffer(std::span(&color, 1), nullptr, "decoded");
        for (const Variant* variant : variants_) {
            trips_.emplace_back(*variant, kSampleColumns, kSampleRows);
            const std::string domain = sample_domain(*variant);
            if (inputs_.contains(domain)) continue;
            auto& input = inputs_[domain];
            input.values = make_samples(*variant, kSampleColumns, kSampleRows);
            input.texture = make_float_texture(kSampleColumns, kSampleRows, "samples");
            input.texture.upload_floats({&input.values.front().x, kPixels * 4});
        }
    }

    // The first draws of the shaders, too: compiling is kept out of the times.
    EncodingResult error_of(size_t i) const {
        const Variant& variant = *variants_[i];
        const FieldKind& kind = field_kind(variant.field);
        const auto& input = inputs_.at(sample_domain(variant));
        trips_[i].encode(input.texture);
        trips_[i].decode(decoded_);
        return {.field = variant.field,
                .name = variant.name,
                .domain = sample_domain(variant),
                .unit = std::string(kind.unit),
                .bits = variant.bits(),
                .error = summarize_errors(kind, input.values, read_pixels(output_)),
                .encode_ns_per_px = {},
                .decode_ns_per_px = {}};
    }

    void time(std::vector<EncodingResult>& results, int rounds) const {
        std::vector<std::vector<double>> encode(trips_.size()), decode(trips_.size());
        for (size_t round = 0; round < static_cast<size_t>(rounds); ++round) {
            for (const size_t i : schedule(trips_.size(), round)) {
                const gl::Texture& input = inputs_.at(sample_domain(*variants_[i])).texture;
                encode[i].push_back(timed_ns_per_px([&] { trips_[i].encode(input); }));
                decode[i].push_back(timed_ns_per_px([&] { trips_[i].decode(decoded_); }));
            }
        }
        for (size_t i = 0; i < trips_.size(); ++i) {
            results[i].encode_ns_per_px = median_interval(encode[i]);
            results[i].decode_ns_per_px = median_interval(decode[i]);
        }
    }

  private:
    struct Input {
        std::vector<glm::vec4> values;
        gl::Texture texture;
    };
    std::vector<const Variant*> variants_;
    std::vector<RoundTrip> trips_;
    std::map<std::string, Input> inputs_;  // by domain
    gl::Texture output_;
    gl::Framebuffer decoded_;
};

}  // namespace

std::vector<EncodingResult> measure_encodings(const std::vector<Variant>& variants, int rounds) {
    CHECK_THAT(rounds >= 1, "{}", rounds);
    std::vector<EncodingResult> all(variants.size());
    std::vector<bool> done(variants.size(), false);
    for (size_t first = 0; first < variants.size(); ++first) {
        if (done[first]) continue;
        std::vector<size_t> indices;
        std::vector<const Variant*> of_field;
        for (size_t i = first; i < variants.size(); ++i) {
            if (variants[i].field != variants[first].field) continue;
            indices.push_back(i);
            of_field.push_back(&variants[i]);
            done[i] = true;
        }
        const FieldRun run(of_field);
        std::vector<EncodingResult> results;
        for (size_t i = 0; i < indices.size(); ++i) results.push_back(run.error_of(i));
        run.time(results, rounds);
        for (size_t i = 0; i < indices.size(); ++i) all[indices[i]] = std::move(results[i]);
    }
    return all;
}

}  // namespace lightsweep

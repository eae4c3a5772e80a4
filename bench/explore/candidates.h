// Layouts that nobody wrote: combinations of encodings, packed by bits into 32-bit words. Pure data; what a candidate
// costs in error and time is measured elsewhere (explore.h).
#pragma once

#include "renderer/gbuffer/layout.h"

#include <map>
#include <span>
#include <string>
#include <vector>

namespace lightsweep {

/// One way to store one field.
struct FieldOption {
    Field field = Field::normal;
    Encoding encoding;
    std::vector<int> bits;  ///< of each channel of the encoding

    int total_bits() const;
    std::string name() const;  ///< `normal=oct_8_8`
};

struct DepthOption {
    gl::Format format = gl::Format::D32F;
    DepthConvention convention = DepthConvention::reversed;

    std::string name() const;  ///< `depth=d24_standard`
};

struct Options {
    std::map<Field, std::vector<FieldOption>> fields;  ///< position is never among them: it is rebuilt from depth
    std::vector<DepthOption> depths;
};

/// Reads bench/explore/options.json or a user's own file. Throws InputError.
Options load_options(const std::string& file);

/// Packs the fields by bits: each within one 32-bit word, widest first into the first word with room. The words become
/// integer targets of four, two and one of them, as few as there can be without an unused word.
Layout pack(const std::string& key, std::span<const FieldOption> fields, const DepthOption& depth);

/// The layout with one field stored as `option` says, in a target of its own, all else as it was. `layout` stores the
/// field.
Layout with_option(const Layout& layout, const FieldOption& option);

/// An option with what it costs: its bits, and the error of the picture when it alone is packed.
struct CostedOption {
    size_t index = 0;  ///< into the list it was taken from
    int bits = 0;
    double error = 0.0;
};

/// Those that no other beats in bits and error both, fewest bits first; of equals the first.
std::vector<CostedOption> undominated(std::vector<CostedOption> options);

}  // namespace lightsweep

// A G-buffer packing layout: which field goes where, in which encoding and format. Data from a JSON file
// (docs/layouts.md); knows what a scene needs, and nothing of passes.
#pragma once

#include "renderer/base/json_reader.h"
#include "renderer/frame/frame.h"
#include "renderer/gbuffer/encoding.h"
#include "renderer/gbuffer/field.h"
#include "renderer/gl/format.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lightsweep {

/// Where one channel of an encoding is kept: a component, or a run of bits of an integer component.
struct Slot {
    int component = 0;  ///< 0 r, 1 g, 2 b, 3 a
    int low_bit = 0;
    int bit_count = 0;  ///< 0: the whole component of a fixed-point or float format
};

struct StoredField {
    Field field;
    Encoding encoding;
    std::vector<Slot> slots;  ///< one for each channel of the encoding
};

struct LayoutTarget {
    std::string name;
    gl::Format format = gl::Format::RGBA8;
    std::vector<StoredField> fields;
};

/// The values that channel `i` of a stored field can have: offset + k * step for integers k. Nothing where they are not
/// evenly spaced (float formats, sRGB) or there are no numbers but bits.
struct ChannelGrid {
    double step = 0.0, offset = 0.0;
};
std::optional<ChannelGrid> channel_grid(gl::Format format, const StoredField& stored, size_t i);

/// The bits that channel `i` takes.
int channel_bits(gl::Format format, const StoredField& stored, size_t i);

struct Layout {
    std::string key;
    std::string summary;
    gl::Format depth = gl::Format::D32F;
    DepthConvention convention = DepthConvention::reversed;
    std::vector<LayoutTarget> targets;

    bool stores(Field field) const;
    /// Of all colour targets and the depth.
    int bytes_per_pixel() const;
};

/// How far a position that comes out of the layout may be off, relative to its distance from the eye: 0 where it is
/// rebuilt from depth (it then lies on the pixel's ray, at the depth that everything else sees) or stored in 32 bits.
double position_error(const Layout& layout);

/// How far a stored depth may be off the exact one: a step of the format and one of the rasteriser, which interpolates
/// in float. 0 where the error is relative to the depth, so to the distance: reversed floats.
double depth_step(gl::Format depth, DepthConvention convention);

/// A shipped layout by its key, or a user's own by its path. Throws InputError with file, place and cure: an unknown
/// field, encoding or format, a channel that does not fit, bits that overlap, a field stored twice.
Layout load_layout(const std::string& key_or_path);
std::vector<std::string> layout_keys();

/// The texts for a DepthConvention in files, by value.
const std::vector<std::string>& depth_convention_names();

/// The encoding that a JSON string names. Throws InputError for an unknown one, or one that cannot carry `field`.
Encoding read_encoding(const JsonReader& json, Field field);

/// One field of a target of the format `format`, from an object with the keys `field`, `encoding` and `in` (others are
/// the caller's). Throws like load_layout.
StoredField read_stored_field(const JsonReader& json, gl::Format format);

/// The layout without the fields that a scene does not need, and without the targets that nothing is left in.
/// Throws InputError naming the field when the scene needs one that the layout does not store (position excepted: it
/// is rebuilt from depth).
Layout drop_unneeded(const Layout& layout, const SceneNeeds& needs);

/// The layout with these fields alone, and without the targets that nothing is left in.
Layout keep_fields(const Layout& layout, std::span<const Field> fields);

}  // namespace lightsweep

// OpenEXR, through memory: files are opened and replaced by renderer/base alone.
#include "renderer/base/check.h"
#include "renderer/base/error.h"
#include "renderer/image/codecs.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfVersion.h>
#include <fmt/format.h>

#include <cstring>
#include <span>
#include <stdexcept>

namespace lightsweep {
namespace {

class MemoryInput final : public Imf::IStream {
  public:
    MemoryInput(const std::string& bytes, const std::string& name) : IStream(name.c_str()), bytes_(bytes) {}
    bool read(char to[], int count) override {
        if (count < 0 || at_ > bytes_.size() || static_cast<size_t>(count) > bytes_.size() - at_)
            throw std::runtime_error("the file ends too early");
        std::memcpy(to, bytes_.data() + at_, static_cast<size_t>(count));
        at_ += static_cast<size_t>(count);
        return at_ < bytes_.size();
    }
    uint64_t tellg() override { return at_; }
    void seekg(uint64_t at) override { at_ = at; }

  private:
    const std::string& bytes_;
    uint64_t at_ = 0;
};

class MemoryOutput final : public Imf::OStream {
  public:
    explicit MemoryOutput(const std::string& name) : OStream(name.c_str()) {}
    void write(const char from[], int count) override {
        const auto size = static_cast<size_t>(count);
        if (at_ + size > bytes.size()) bytes.resize(at_ + size);
        bytes.replace(at_, size, from, size);
        at_ += size;
    }
    uint64_t tellp() override { return at_; }
    void seekp(uint64_t at) override { at_ = at; }

    std::string bytes;

  private:
    size_t at_ = 0;
};

constexpr const char* kRgb[] = {"R", "G", "B"};
constexpr const char* kGrey[] = {"Y", "Y", "Y"};

/// The channels that make red, green and blue. A subsampled channel is part of a luminance-chroma picture, whose Y
/// alone would be a different picture.
std::span<const char* const, 3> find_channels(const Imf::ChannelList& channels, const std::string& name) {
    const auto whole = [&](const char* key) {
        const Imf::Channel* channel = channels.findChannel(key);
        return channel != nullptr && channel->xSampling == 1 && channel->ySampling == 1;
    };
    if (whole("R") && whole("G") && whole("B")) return kRgb;
    if (whole("Y") && channels.findChannel("RY") == nullptr && channels.findChannel("BY") == nullptr) return kGrey;
    std::string found;
    for (auto i = channels.begin(); i != channels.end(); ++i)
        found += (found.empty() ? "" : ", ") + std::string(i.name());
    throw InputError(name, "has the channels " + found + "; allowed: R, G and B, or Y alone, not subsampled");
}

/// Channel 0..2 of `image`, whose first pixel is the data window's. OpenEXR has one type for reading and writing.
Imf::Slice slice_of(const Image& image, size_t channel, const Imath::Box2i& window) {
    return Imf::Slice::Make(Imf::FLOAT, image.rgb.data() + channel, window, 3 * sizeof(float),
                            3 * sizeof(float) * static_cast<size_t>(image.width));
}

Image decode(const std::string& bytes, const std::string& name) {
    MemoryInput stream(bytes, name);
    Imf::InputFile file(stream);
    const Imath::Box2i window = file.header().dataWindow();
    const int64_t width = int64_t{window.max.x} - window.min.x + 1;
    const int64_t height = int64_t{window.max.y} - window.min.y + 1;
    if (width * height > kMaxFilePixels)
        throw InputError(name,
                         fmt::format("{}x{} is too large; allowed: up to {} pixels", width, height, kMaxFilePixels));
    const auto channels = find_channels(file.header().channels(), name);
    if (!file.isComplete()) throw std::runtime_error("the file ends too early");

    Image image(static_cast<int>(width), static_cast<int>(height), ColorSpace::linear);
    Imf::FrameBuffer buffer;
    if (channels.data() == kGrey) {
        buffer.insert("Y", slice_of(image, 0, window));
    } else {
        for (size_t c = 0; c < 3; ++c) buffer.insert(channels[c], slice_of(image, c, window));
    }
    file.setFrameBuffer(buffer);
    file.readPixels(window.min.y, window.max.y);
    if (channels.data() == kGrey)
        for (size_t i = 0; i < image.rgb.size(); i += 3) image.rgb[i + 1] = image.rgb[i + 2] = image.rgb[i];
    return image;
}

}  // namespace

Image decode_exr(const std::string& bytes, const std::string& name) {
    if (bytes.size() < 4 || !Imf::isImfMagic(bytes.data())) throw InputError(name, "is not an OpenEXR file");
    // OpenEXR allocates its line table from the header before anything of ours can look at it.
    static const bool limited = [] {
        Imf::Header::setMaxImageSize(1 << 16, 1 << 16);
        return true;
    }();
    CHECK(limited);
    try {
        return decode(bytes, name);
    } catch (const InputError&) {
        throw;
    } catch (const std::exception& error) {
        throw InputError(name, fmt::format("is a damaged OpenEXR file: {}", error.what()));
    }
}

std::string encode_exr(const Image& image, const std::string& name) {
    CHECK(image.space == ColorSpace::linear);
    Imf::Header header(image.width, image.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer buffer;
    for (size_t c = 0; c < 3; ++c) {
        header.channels().insert(kRgb[c], Imf::Channel(Imf::FLOAT));
        buffer.insert(kRgb[c], slice_of(image, c, header.dataWindow()));
    }
    MemoryOutput stream(name);
    {
        Imf::OutputFile file(stream, header);
        file.setFrameBuffer(buffer);
        file.writePixels(image.height);
    }
    return std::move(stream.bytes);
}

}  // namespace lightsweep

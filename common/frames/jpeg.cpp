#include "common/frames/jpeg.h"

#include <turbojpeg.h>

#include <stdexcept>

#include "common/image/rgbd_frame.h"

namespace roomwise {
namespace {

struct CloseHandle {
  void operator()(void* handle) const { tjDestroy(handle); }
};
using Handle = std::unique_ptr<void, CloseHandle>;

std::size_t rgb_bytes(int width_px, int height_px) {
  return static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px) * 3;
}

bool is_side(int px) { return px >= 1 && px <= kImageSideMax_px; }

Handle checked(tjhandle handle) {
  if (handle == nullptr) throw std::runtime_error("cannot start libturbojpeg");
  return Handle(handle);
}

}  // namespace

struct JpegDecoder::Library {
  Handle handle = checked(tjInitDecompress());
};
struct JpegEncoder::Library {
  Handle handle = checked(tjInitCompress());
};

JpegDecoder::JpegDecoder() : library_(std::make_unique<Library>()) {}
JpegDecoder::~JpegDecoder() = default;
JpegEncoder::JpegEncoder() : library_(std::make_unique<Library>()) {}
JpegEncoder::~JpegEncoder() = default;

bool JpegDecoder::decode(std::span<const std::uint8_t> bytes, int width_px, int height_px,
                         std::span<std::uint8_t> rgb) {
  if (!is_side(width_px) || !is_side(height_px) || rgb.size() != rgb_bytes(width_px, height_px)) {
    return false;
  }
  const tjhandle handle = library_->handle.get();
  int width = 0;
  int height = 0;
  int subsampling = 0;
  int colour_space = 0;
  if (tjDecompressHeader3(handle, bytes.data(), bytes.size(), &width, &height, &subsampling,
                          &colour_space) != 0 ||
      width != width_px || height != height_px) {
    return false;
  }
  // LIMITSCANS: a progressive JPEG of thousands of empty scans would take minutes.
  return tjDecompress2(handle, bytes.data(), bytes.size(), rgb.data(), width, 0, height, TJPF_RGB,
                       TJFLAG_STOPONWARNING | TJFLAG_LIMITSCANS) == 0;
}

void JpegEncoder::encode(std::span<const std::uint8_t> rgb, int width_px, int height_px,
                         int quality, std::vector<std::uint8_t>& out) {
  if (!is_side(width_px) || !is_side(height_px) || rgb.size() != rgb_bytes(width_px, height_px) ||
      quality < 1 || quality > 100) {
    throw std::invalid_argument("JPEG: size does not match the pixels, or quality out of range");
  }
  out.resize(tjBufSize(width_px, height_px, TJSAMP_420));
  unsigned char* buffer = out.data();
  unsigned long size = out.size();
  if (tjCompress2(library_->handle.get(), rgb.data(), width_px, 0, height_px, TJPF_RGB, &buffer,
                  &size, TJSAMP_420, quality, TJFLAG_NOREALLOC) != 0) {
    throw std::logic_error("libturbojpeg refused an image");
  }
  out.resize(size);
}

}  // namespace roomwise

// Any bytes as a camera's frame: refused by name, or a picture whose brightness lies in [0, 1].

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "runtime/probe/frame_picture.h"

namespace {

void require(bool held) {
    if (!held) {
        std::abort();
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gazeloop;
    probe::FramePicture picture;
    const auto read = picture.read(std::as_bytes(std::span(data, size)), "fuzz");
    if (!read) {
        require(read.error().kind == ErrorKind::BadInput &&
                read.error().message.starts_with("fuzz:"));
        return 0;
    }
    const double brightness = picture.brightness({0, 0, picture.width(), picture.height()});
    require(brightness >= 0.0 && brightness <= 1.0);
    return 0;
}

// Any bytes as a picture to compare: refused by name, or as many pixels as its size says, all in
// [0, 1].

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "runtime/render/png_file.h"

namespace {

void require(bool held) {
    if (!held) {
        std::abort();
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gazeloop;
    const auto picture = render::read_png(std::as_bytes(std::span(data, size)), "fuzz");
    if (!picture) {
        require(picture.error().kind == ErrorKind::BadInput &&
                picture.error().message.starts_with("fuzz:"));
        return 0;
    }
    require(picture->pixels.size() == std::size_t{picture->width} * picture->height);
    for (const glm::vec3& pixel : picture->pixels) {
        for (int channel = 0; channel < 3; ++channel) {
            require(pixel[channel] >= 0.0F && pixel[channel] <= 1.0F);
        }
    }
    return 0;
}

#include "runtime/quality/compared_pictures.h"

#include <fmt/core.h>

#include <cmath>

namespace gazeloop::quality {
namespace {

std::unexpected<Error> refuse(std::string text) {
    return std::unexpected(Error{ErrorKind::BadInput, std::move(text)});
}

/// False for not-a-number.
bool is_light(const glm::vec3& pixel) {
    return std::abs(pixel.x) <= kMostLight && std::abs(pixel.y) <= kMostLight &&
           std::abs(pixel.z) <= kMostLight;
}

Expected<void> check(const char* which, const render::LinearPicture& picture) {
    const std::size_t count = std::size_t{picture.width} * picture.height;
    if (count == 0 || picture.pixels.size() != count) {
        return refuse(fmt::format("the {}: {} pixels for {}x{}: render or read it again", which,
                                  picture.pixels.size(), picture.width, picture.height));
    }
    std::size_t bad = 0;
    std::size_t first = 0;
    for (std::size_t at = 0; at < count; ++at) {
        if (!is_light(picture.pixels[at])) {
            first = bad == 0 ? at : first;
            ++bad;
        }
    }
    if (bad > 0) {
        return refuse(fmt::format(
            "the {}: {} of {} pixels are not finite or over {:g}, the first at {},{}: nothing can "
            "be said of such a picture; find what made them",
            which, bad, count, kMostLight, first % picture.width, first / picture.width));
    }
    return {};
}

}  // namespace

Expected<void> check_pictures(const render::LinearPicture& reference,
                              const render::LinearPicture& test, const gaze::EyeView& view) {
    if (auto checked = check("reference", reference); !checked) {
        return checked;
    }
    if (auto checked = check("test picture", test); !checked) {
        return checked;
    }
    if (reference.width != test.width || reference.height != test.height) {
        return refuse(fmt::format(
            "the reference has {}x{} pixels, the test picture {}x{}: compare pictures of one size",
            reference.width, reference.height, test.width, test.height));
    }
    if (reference.width != view.width_px || reference.height != view.height_px) {
        return refuse(fmt::format(
            "the pictures have {}x{} pixels where {}x{} are expected: compare pictures of one size",
            reference.width, reference.height, view.width_px, view.height_px));
    }
    return {};
}

}  // namespace gazeloop::quality

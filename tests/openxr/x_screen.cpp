#include "tests/openxr/x_screen.h"

#include <xcb/xcb.h>

#include <cstdlib>
#include <memory>

namespace gazeloop::tests {

XScreen::XScreen(const ScratchFolder& scratch)
    : process_({.command = {"Xvfb", "-displayfd", "1", "-screen", "0", "1280x720x24", "-nolisten",
                            "tcp", "-noreset"},
                .environment = {},
                .output_file = scratch.file("xvfb.log")}),
      // It writes the number of the display that it has found free, and a newline.
      ready_(process_.says("\n", std::chrono::seconds(30))) {}

std::string XScreen::display() const {
    return ":" + std::to_string(std::atoi(process_.output().c_str()));
}

std::optional<Image> XScreen::capture(std::uint16_t width, std::uint16_t height) const {
    const std::unique_ptr<xcb_connection_t, decltype(&xcb_disconnect)> connection(
        xcb_connect(display().c_str(), nullptr), xcb_disconnect);
    if (xcb_connection_has_error(connection.get()) != 0) {
        return std::nullopt;
    }
    const xcb_window_t root = xcb_setup_roots_iterator(xcb_get_setup(connection.get())).data->root;
    constexpr std::uint32_t kAllPlanes = ~0U;
    const std::unique_ptr<xcb_get_image_reply_t, decltype(&std::free)> reply(
        xcb_get_image_reply(connection.get(),
                            xcb_get_image(connection.get(), XCB_IMAGE_FORMAT_Z_PIXMAP, root, 0, 0,
                                          width, height, kAllPlanes),
                            nullptr),
        std::free);
    const std::size_t count = std::size_t{width} * height;
    constexpr std::size_t kBytesPerPixel = 4;  // blue, green, red, nothing
    if (reply == nullptr || static_cast<std::size_t>(xcb_get_image_data_length(reply.get())) !=
                                count * kBytesPerPixel) {
        return std::nullopt;
    }
    const std::uint8_t* const bytes = xcb_get_image_data(reply.get());
    Image image{width, height};
    image.pixels.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint8_t* const pixel = bytes + i * kBytesPerPixel;
        image.pixels.push_back({pixel[2], pixel[1], pixel[0]});
    }
    return image;
}

}  // namespace gazeloop::tests

#include "tests/openxr/x_screen.h"

#include <xcb/xcb.h>

#include <cstdlib>
#include <memory>
#include <sstream>
#include <thread>

namespace gazeloop::tests {
namespace {

/// The number of the display that the server has found free: a line of its own, among complaints
/// about displays that are not. Empty: it has not said so.
std::string number_said(const BackgroundProcess& process) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (std::chrono::steady_clock::now() < deadline) {
        std::istringstream lines(process.output());
        for (std::string line; std::getline(lines, line) && !lines.eof();) {
            if (!line.empty() && line.find_first_not_of("0123456789") == std::string::npos) {
                return line;
            }
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return "";
}

}  // namespace

XScreen::XScreen(const ScratchFolder& scratch)
    : process_({.command = {"Xvfb", "-displayfd", "1", "-screen", "0", "1280x720x24", "-nolisten",
                            "tcp", "-noreset"},
                .environment = {},
                .output_file = scratch.file("xvfb.log")}),
      number_(number_said(process_)) {}

std::string XScreen::display() const { return ":" + number_; }

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

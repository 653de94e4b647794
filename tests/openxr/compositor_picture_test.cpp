// What we submit is what an eye would see: Monado's main compositor shows it in a window, and the
// window is compared with the program's own pictures of both eyes.
//
// The simulated headset has no distortion and does not move its head, and its window is as large as
// the pictures that it asks for here: one pixel of ours is one pixel of the window's.
#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <functional>
#include <set>
#include <thread>

#include "tests/openxr/monado_service.h"
#include "tests/openxr/x_screen.h"

namespace gazeloop::tests {
namespace {

constexpr std::uint32_t kEyeWidth = 320;
constexpr std::uint32_t kHeight = 360;

Image read_png(const std::string& file) {
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    Image image;
    if (png_image_begin_read_from_file(&png, file.c_str()) != 0) {
        png.format = PNG_FORMAT_RGB;
        image = {png.width, png.height};
        image.pixels.resize(std::size_t{png.width} * png.height);
        png_image_finish_read(&png, nullptr, image.pixels.data(), 0, nullptr);
    }
    return image;
}

/// A picture whose pixel at (x, y) is what the function says.
Image drawn(std::uint32_t width, std::uint32_t height,
            const std::function<std::array<std::uint8_t, 3>(std::uint32_t, std::uint32_t)>& pixel) {
    Image image{width, height};
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            image.pixels.push_back(pixel(x, y));
        }
    }
    return image;
}

Image side_by_side(const Image& left, const Image& right) {
    return drawn(left.width + right.width, left.height, [&](std::uint32_t x, std::uint32_t y) {
        return x < left.width ? left.at(x, y) : right.at(x - left.width, y);
    });
}

Image mirrored(const Image& image) {
    return drawn(image.width, image.height, [&](std::uint32_t x, std::uint32_t y) {
        return image.at(image.width - 1 - x, y);
    });
}

Image upside_down(const Image& image) {
    return drawn(image.width, image.height, [&](std::uint32_t x, std::uint32_t y) {
        return image.at(x, image.height - 1 - y);
    });
}

Image moved(const Image& image, std::uint32_t right_px, std::uint32_t down_px) {
    return drawn(image.width, image.height, [&](std::uint32_t x, std::uint32_t y) {
        return image.at(std::min(x + right_px, image.width - 1),
                        std::min(y + down_px, image.height - 1));
    });
}

/// Seen through a field of view that is wider or narrower about the picture's centre.
Image scaled(const Image& image, double factor) {
    const auto at = [factor](std::uint32_t i, std::uint32_t size) {
        const double from = (i + 0.5 - size / 2.0) * factor + size / 2.0;
        return static_cast<std::uint32_t>(std::clamp(std::floor(from), 0.0, size - 1.0));
    };
    return drawn(image.width, image.height, [&](std::uint32_t x, std::uint32_t y) {
        return image.at(at(x, image.width), at(y, image.height));
    });
}

Image through(const Image& image, const std::function<double(double)>& curve) {
    return drawn(image.width, image.height, [&](std::uint32_t x, std::uint32_t y) {
        std::array<std::uint8_t, 3> pixel = image.at(x, y);
        for (std::uint8_t& channel : pixel) {
            channel = static_cast<std::uint8_t>(std::lround(255.0 * curve(channel / 255.0)));
        }
        return pixel;
    });
}

double encoded(double c) {
    return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055;
}
double decoded(double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); }

/// Mean difference of a channel, in levels of 255, of the nine tenths of the pixels that differ
/// least: the scene moves between the window's frame and the last one, of which the pictures are.
double difference(const Image& a, const Image& b) {
    std::vector<double> levels;
    levels.reserve(a.pixels.size());
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        double sum = 0.0;
        for (std::size_t c = 0; c < 3; ++c) {
            sum += std::abs(int{a.pixels[i][c]} - int{b.pixels[i][c]});
        }
        levels.push_back(sum / 3.0);
    }
    std::ranges::sort(levels);
    const std::size_t kept = levels.size() * 9 / 10;
    double sum = 0.0;
    for (std::size_t i = 0; i < kept; ++i) {
        sum += levels[i];
    }
    return sum / static_cast<double>(kept);
}

struct Wrong {
    const char* name;
    Image picture;
};

std::vector<Wrong> everything_wrong(const Image& left, const Image& right) {
    const auto both = [&](auto&& change) { return side_by_side(change(left), change(right)); };
    return {
        {"eyes exchanged", side_by_side(right, left)},
        {"mirrored", both(mirrored)},
        {"window mirrored", mirrored(side_by_side(left, right))},
        {"upside down", both(upside_down)},
        {"encoded twice", both([](const Image& eye) { return through(eye, encoded); })},
        {"not encoded", both([](const Image& eye) { return through(eye, decoded); })},
        {"a pixel to the left", both([](const Image& eye) { return moved(eye, 1, 0); })},
        {"a pixel up", both([](const Image& eye) { return moved(eye, 0, 1); })},
        {"field of view 3 % wider", both([](const Image& eye) { return scaled(eye, 1.03); })},
        {"field of view 3 % narrower", both([](const Image& eye) { return scaled(eye, 0.97); })}};
}

class CompositorPicture : public testing::Test {
  protected:
    void SetUp() override {
        ASSERT_TRUE(MonadoService::folder())
            << "no Monado service in the cache folder: ./dev test builds it";
        screen_.emplace(scratch_);
        ASSERT_TRUE(screen_->ready()) << "no X server without a screen: ./dev test installs xvfb";
        // Views that are not symmetric, so that no exchange of edges or eyes goes unnoticed.
        service_.emplace(scratch_, Environment{{"DISPLAY", screen_->display()},
                                               {"XRT_COMPOSITOR_FORCE_XCB", "1"},
                                               {"XRT_COMPOSITOR_SCALE_PERCENTAGE", "50"},
                                               {"GAZELOOP_DISPLAY_FOV_LEFT", "-48,38,40,-34"},
                                               {"GAZELOOP_DISPLAY_FOV_RIGHT", "-36,46,40,-34"}});
        ASSERT_TRUE(service_->ready()) << service_->process().output();
    }

    /// Runs until the window shows frames, takes its picture, and ends the run. The program's own
    /// pictures then lie in the scratch folder.
    void run_and_capture(const std::vector<std::string>& arguments) {
        std::vector<std::string> words{
            "run",   "--snapshot", scratch_.file("pictures"), "--log-level",
            "debug", "--set",      "vulkan.validation=true"};
        words.insert(words.end(), arguments.begin(), arguments.end());
        const ProgramResult result =
            run_gazeloop(words, {.environment = MonadoService::client_environment(scratch_),
                                 .trigger = "session state: FOCUSED",
                                 .on_trigger = [&](int pid) {
                                     wait_for_frames();
                                     kill(pid, SIGINT);
                                 }});
        ASSERT_EQ(result.exit_code, 130) << result.err;
        EXPECT_EQ(result.err.find("Vulkan validation"), std::string::npos) << result.err;
        ASSERT_TRUE(window_.has_value())
            << service_->process().output() << "X server: " << screen_->process().output()
            << " ended: " << screen_->process().wait(std::chrono::seconds(0));
    }

    void wait_for_frames() {
        constexpr std::size_t kColoursOfAScene = 2000;
        const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
        bool shown = false;
        while (std::chrono::steady_clock::now() < deadline) {
            auto now = screen_->capture(2 * kEyeWidth, kHeight);
            if (shown && now) {
                window_ = now;  // the compositor has had time for a whole frame
                return;
            }
            shown = shown || (now && std::set(now->pixels.begin(), now->pixels.end()).size() >
                                         kColoursOfAScene);
            std::this_thread::sleep_for(std::chrono::milliseconds(shown ? 500 : 50));
        }
    }

    /// The right picture must be all but equal, and every wrong one far worse.
    void compare(const std::string& which, std::vector<Wrong> more = {}) {
        const Image left = picture("left", which);
        const Image right = picture("right", which);
        const double as_it_is = difference(*window_, side_by_side(left, right));
        EXPECT_LT(as_it_is, 0.1);
        std::vector<Wrong> wrong = everything_wrong(left, right);
        wrong.insert(wrong.end(), more.begin(), more.end());
        for (const Wrong& one : wrong) {
            EXPECT_GT(difference(*window_, one.picture), 10.0 * as_it_is + 0.5) << one.name;
        }
    }

    [[nodiscard]] Image picture(const std::string& eye, const std::string& which) const {
        Image image = read_png(scratch_.file("pictures/" + eye + "-" + which + ".png"));
        EXPECT_EQ(image.width, kEyeWidth);
        EXPECT_EQ(image.height, kHeight);
        return image;
    }

    ScratchFolder scratch_;
    std::optional<XScreen> screen_;
    std::optional<MonadoService> service_;
    std::optional<Image> window_;
};

TEST_F(CompositorPicture, IsOursAtFullResolution) {
    run_and_capture({"--method", "full"});
    compare("full");
}

TEST_F(CompositorPicture, IsOursFoveated) {
    run_and_capture({"--method", "kfr", "--sigma", "4", "--gaze", "fixed:-14,9"});
    const Image full = side_by_side(picture("left", "full"), picture("right", "full"));
    compare("result", {{"full resolution", full}});
}

}  // namespace
}  // namespace gazeloop::tests

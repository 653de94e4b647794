#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <numbers>
#include <utility>

#include "runtime/render/off_screen.h"
#include "runtime/render/srgb.h"
#include "tests/bench/bench.h"
#include "tests/bench/raycast_setup.h"

namespace gazeloop::bench {
namespace {

constexpr vk::Extent2D kExtent(160, 120);
constexpr double kHalfWidth_rad = 0.6;
constexpr double kFrameSeconds = 1.0 / 90.0;
constexpr std::uint64_t kFrames = 12;
/// Frames before the first that counts, in which what accumulates fills.
constexpr std::uint64_t kFilling = 8;
/// How much finer each way the pictures are that the others are held against.
constexpr std::uint32_t kFiner = 3;

/// A way to render with or without something.
struct Ingredient {
    std::string name;
    render::Method method = render::Method::Kfr;
    render::FilterUse lp_gaussian = render::FilterUse::Off;
    render::Antialiasing antialiasing{};
    scene::SceneOptions scene{};
};

std::vector<Ingredient> ingredients() {
    using render::Antialiasing;
    using enum render::FilterUse;
    using enum render::Method;
    const Antialiasing over_frames{.over_frames = true};
    const Antialiasing all{.post_filter_px = 7, .footprint_taps = 4, .over_frames = true};
    return {
        {.name = "full", .method = Full},
        {.name = "full, taa", .method = Full, .antialiasing = over_frames},
        {.name = "full, no specular filter", .method = Full, .scene = {.specular_filter = false}},
        {.name = "kfr"},
        {.name = "kfr, no specular filter", .scene = {.specular_filter = false}},
        {.name = "kfr, lp_gaussian", .lp_gaussian = On},
        {.name = "kfr, footprint_taps 4", .antialiasing = {.footprint_taps = 4}},
        {.name = "kfr, post_filter 7", .antialiasing = {.post_filter_px = 7}},
        {.name = "kfr, post_filter 39", .antialiasing = {.post_filter_px = 39}},
        {.name = "kfr, footprint", .scene = {.footprint = true}},
        {.name = "kfr, taa", .antialiasing = over_frames},
        {.name = "kfr, taa, lp_gaussian, footprint",
         .lp_gaussian = On,
         .antialiasing = over_frames,
         .scene = {.footprint = true}},
        {.name = "kfr, all", .lp_gaussian = On, .antialiasing = all, .scene = {.footprint = true}}};
}

/// How much pictures change from frame to frame, how much of that is not the truth's own change (it
/// moves too), and how far they are from the truth; channels, codes of 255.
class Changes {
  public:
    void add(const render::Picture& now, const render::Picture& truth) {
        for (std::size_t i = 0; i < now.pixels.size(); ++i) {
            for (std::size_t c = 0; c < 3; ++c) {
                error_ += std::abs(now.pixels[i][c] - truth.pixels[i][c]);
                errors_ += 1.0;
                if (!before_.pixels.empty()) {
                    const int change = now.pixels[i][c] - before_.pixels[i][c];
                    const int true_change = truth.pixels[i][c] - truth_before_.pixels[i][c];
                    ++changes_.at(static_cast<std::size_t>(std::abs(change)));
                    flicker_ += std::abs(change - true_change);
                }
            }
        }
        before_ = now;
        truth_before_ = truth;
    }
    [[nodiscard]] double mean() const {
        double sum = 0.0;
        for (std::size_t change = 0; change < changes_.size(); ++change) {
            sum += static_cast<double>(change * changes_.at(change));
        }
        return sum / static_cast<double>(count());
    }
    /// The change that 5 % of the channels exceed, between whole codes.
    [[nodiscard]] double p95() const {
        const double wanted = 0.95 * static_cast<double>(count());
        double below = 0.0;
        for (std::size_t change = 0; change < changes_.size(); ++change) {
            const double here = static_cast<double>(changes_.at(change));
            if (below + here >= wanted) {
                return static_cast<double>(change) + (wanted - below) / here - 0.5;
            }
            below += here;
        }
        return 255.0;
    }
    [[nodiscard]] double error() const { return error_ / errors_; }
    [[nodiscard]] double flicker() const { return flicker_ / static_cast<double>(count()); }

  private:
    [[nodiscard]] std::uint64_t count() const {
        std::uint64_t sum = 0;
        for (const std::uint64_t channels : changes_) {
            sum += channels;
        }
        return sum;
    }

    render::Picture before_;
    render::Picture truth_before_;
    std::array<std::uint64_t, 256> changes_{};
    double error_ = 0.0;
    double errors_ = 0.0;
    double flicker_ = 0.0;
};

class FlyThrough {
  public:
    /// `finer` times as many pixels each way.
    FlyThrough(const vulkan::Context& context, std::string_view scene_name, std::uint32_t finer = 1)
        : context_(context),
          scene_name_(scene_name),
          setup_(context, vk::Extent2D(finer * kExtent.width, finer * kExtent.height),
                 kHalfWidth_rad) {}

    /// `follow` gets each frame that counts, by its number and in the renderer that drew it.
    template <typename Follow>
    void render(const Ingredient& by, std::uint32_t samples, const Follow& follow) const {
        render::MethodConfig config = setup_.config({});
        config.samples = samples;
        config.method = by.method;
        config.lp_gaussian = by.lp_gaussian;
        config.antialiasing = by.antialiasing;
        render::OffScreen off_screen(context_, scene_of(by.scene), render::passes_of(config),
                                     config);
        for (std::uint64_t frame = 0; frame < kFilling + kFrames; ++frame) {
            const render::FrameRequest request = at(frame);
            off_screen.render(request.frame_view(), request.fovea());
            if (frame >= kFilling) {
                follow(frame - kFilling, off_screen);
            }
        }
    }

  private:
    /// One scene serves all who ask for it alike.
    [[nodiscard]] scene::Scene& scene_of(const scene::SceneOptions& options) const {
        auto& made =
            scenes_.at((options.specular_filter ? 2U : 0U) + (options.footprint ? 1U : 0U));
        if (made == nullptr) {
            made = scene::make_scene(context_, scene_name_, options);
        }
        return *made;
    }

    /// The head walks ahead at .2 m/s and turns by 4 degrees a second; the gaze rests in the
    /// middle. Nothing else moves.
    [[nodiscard]] render::FrameRequest at(std::uint64_t frame) const {
        const double time_s = static_cast<double>(frame) * kFrameSeconds;
        render::FrameRequest request = setup_.frame(20.0 + 4.0 * time_s, setup_.centre());
        request.index = frame;
        for (gaze::EyeView& view : request.views) {
            view.pose.position_m = {0.0, 0.0, -0.2 * time_s};
        }
        return request;
    }

    const vulkan::Context& context_;
    std::string scene_name_;
    RaycastSetup setup_;
    mutable std::array<std::unique_ptr<scene::Scene>, 4> scenes_;
};

/// Each pixel the mean, in linear light, of what as many finer ones show.
render::Picture coarser(const render::LinearPicture& fine, std::uint32_t finer) {
    render::Picture picture{
        .width = fine.width / finer, .height = fine.height / finer, .pixels = {}};
    for (std::uint32_t y = 0; y < picture.height; ++y) {
        for (std::uint32_t x = 0; x < picture.width; ++x) {
            glm::vec3 sum(0.0F);
            for (std::uint32_t i = 0; i < finer * finer; ++i) {
                sum += fine.pixels[(std::size_t{y} * finer + i / finer) * fine.width +
                                   std::size_t{x} * finer + i % finer];
            }
            const glm::vec3 mean = sum / static_cast<float>(finer * finer);
            auto& pixel = picture.pixels.emplace_back();
            for (int c = 0; c < 3; ++c) {
                pixel.at(static_cast<std::size_t>(c)) =
                    static_cast<std::uint8_t>(std::lround(255.0 * render::srgb_encoded(mean[c])));
            }
        }
    }
    return picture;
}

}  // namespace

std::vector<Figure> stability(const Options& options) {
    const vulkan::Context context({}, nullptr);
    std::vector<Figure> figures;
    for (const std::string_view scene : {"raymarch", "gallery"}) {
        if (!options.wants(scene)) {
            continue;
        }
        // What each pixel shows in the mean.
        std::vector<render::Picture> truth(kFrames);
        FlyThrough(context, scene, kFiner)
            .render({.name = "truth", .method = render::Method::Full}, 1,
                    [&](std::uint64_t frame, const render::OffScreen& shown) {
                        truth.at(frame) = coarser(shown.linear_picture(gaze::Eye::Left), kFiner);
                    });
        const auto add = [&](const std::string& of, const Changes& changes) {
            for (const auto& [what, value] :
                 {std::pair("mean change", changes.mean()), std::pair("P95 change", changes.p95()),
                  std::pair("flicker", changes.flicker()), std::pair("error", changes.error())}) {
                figures.push_back({.bench = "stability",
                                   .name = std::string(scene),
                                   .metric = fmt::format("{}: {}", of, what),
                                   .value = value,
                                   .unit = "code",
                                   .better = "lower"});
            }
        };
        // The least that any picture of this flight changes by.
        Changes of_truth;
        for (const render::Picture& picture : truth) {
            of_truth.add(picture, picture);
        }
        add("truth", of_truth);
        const FlyThrough flight(context, scene);
        for (const Ingredient& by : ingredients()) {
            Changes changes;
            flight.render(by, options.samples.value_or(1),
                          [&](std::uint64_t frame, const render::OffScreen& shown) {
                              changes.add(shown.picture(gaze::Eye::Left), truth.at(frame));
                          });
            add(by.name, changes);
        }
    }
    return figures;
}

}  // namespace gazeloop::bench

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "runtime/error.h"
#include "runtime/foveation/plans/kfr3d_plan.h"
#include "runtime/quality/psnr.h"
#include "runtime/scene/light_field_file.h"
#include "runtime/scene/scenes.h"
#include "sim/light_field_baker.h"
#include "tests/bench/bench.h"
#include "tests/bench/timed_method.h"
#include "tests/support/method_by_settings.h"

namespace gazeloop::bench {
namespace {

/// The paper has 25 x 25 views of 1024 x 1024; views and picture are smaller here, which changes no
/// ratio of samples but for the texels that bands round up to.
struct Sizes {
    std::uint32_t views;  ///< a side
    std::uint32_t view_px;
    std::uint32_t picture_px;
};
constexpr Sizes kWholeField{25, 256, 512};
constexpr Sizes kQuickField{9, 64, 128};

/// A side of the picture that shows how frames wait for views.
constexpr std::uint32_t kMemoryPicture_px = 128;

/// A side of the other eye's picture: the smallest that sigma 3 makes an LP-buffer of.
constexpr std::uint32_t kOtherEyePicture_px = 16;

constexpr double kField_deg = 90.0;
/// A lens that takes all views, as the paper does, and one that asks for some of them.
constexpr double kWideLens_m = 1.0;
constexpr double kNarrowLens_m = 0.025;

struct Case {
    const char* name;
    const char* sigma;
    std::optional<double> target;         ///< of the published speed-up
    std::optional<double> narrow_target;  ///< where views are left out
};
constexpr Case kCases[] = {{"sigma1.2", "1.2", std::nullopt, std::nullopt},
                           {"sigma2", "2.0", 3.47, 12.0},
                           {"sigma3", "3.0", 7.28, 12.0}};

/// A light field of the ray-marched scene, made once.
std::filesystem::path light_field(const vulkan::Context& context, const Sizes& sizes) {
    const std::filesystem::path folder =
        std::filesystem::path(GAZELOOP_BINARY_DIR) /
        fmt::format("light-field-{}-{}", sizes.views, sizes.view_px);
    std::filesystem::path file = folder / fmt::format("views{}", scene::kLightFieldExtension);
    if (!std::filesystem::exists(file)) {
        std::filesystem::remove_all(folder);
        const auto scene = scene::make_scene(context, "raymarch");
        return value_or_throw(sim::bake_light_field(
            context, *scene,
            {.views = sizes.views, .size_px = sizes.view_px, .field_deg = kField_deg, .samples = 4},
            folder, [](std::uint32_t, std::uint32_t) { return true; }));
    }
    return file;
}

/// Texture samples of the left eye's picture, by counting: texels times the views of their region,
/// pixels of the disc times all views, and what the resolve reads.
double counted_samples(const foveation::EyePlan& plan, std::uint32_t regions, double pixels) {
    double samples = 0.0;
    double views = 0.0;
    for (std::uint32_t region = 0; region < regions; ++region) {
        const double in_region = foveation::Kfr3dPlan::views_in(plan.table, region);
        samples += in_region * static_cast<double>(plan.grids.at(region).counts.shaded);
        views += in_region;
    }
    return samples + views * static_cast<double>(plan.grids.at(regions).counts.shaded) +
           (regions + 1.0) * pixels;
}

/// By Eq. 14, with the N + 1 reads of pass II.
double samples_by_formula(const foveation::EyePlan& plan, std::uint32_t regions, double pixels,
                          double sigma, double growth) {
    double per_pixel = regions;
    for (std::uint32_t region = 0; region < regions; ++region) {
        const double coarser = sigma * std::pow(growth, region);
        per_pixel += foveation::Kfr3dPlan::views_in(plan.table, region) / (coarser * coarser);
    }
    return per_pixel * pixels;
}

/// The root of the mean squared difference in linear light.
double difference(const render::LinearPicture& a, const render::LinearPicture& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const glm::vec3 apart = a.pixels[i] - b.pixels[i];
        sum += glm::dot(apart, apart) / 3.0;
    }
    return std::sqrt(sum / static_cast<double>(a.pixels.size()));
}

/// Both eyes at one place, `across_m` to the right of the cameras' middle.
render::FrameView frame_at(double across_m, const render::RendererConfig& config) {
    render::FrameView frame;
    const double half_rad = std::atan(1.0) * kField_deg / 90.0;
    for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
        frame.views[e] = {.pose = {.position_m = {across_m, 0.0, 0.0}},
                          .fov = {-half_rad, half_rad, half_rad, -half_rad},
                          .width_px = config.extents[e].width,
                          .height_px = config.extents[e].height};
    }
    return frame;
}

render::RendererConfig config_of(const Sizes& sizes) {
    render::RendererConfig config;
    config.extents = {vk::Extent2D(sizes.picture_px, sizes.picture_px),
                      vk::Extent2D(kOtherEyePicture_px, kOtherEyePicture_px)};
    return config;
}

/// One lens: full resolution of all views, and what KFR and 3D-KFR make of it.
class Measurement {
  public:
    Measurement(const vulkan::Context& context, const std::filesystem::path& file,
                double aperture_m, const Sizes& sizes, const Case& at)
        : context_(context), sizes_(sizes), case_(at), config_(config_of(sizes)) {
        scene::SceneOptions options;
        options.light_field.aperture_m = aperture_m;
        needed_ = scene::make_scene(context, file.string(), options);
        options.require_all = true;
        all_ = scene::make_scene(context, file.string(), options);
        add("full", *all_, "full");
        add("full, needed views", *needed_, "full");
        add("kfr", *needed_, "kfr");
        add("kfr3d, all views", *all_, "kfr3d");
        add("kfr3d", *needed_, "kfr3d");
    }

    void run(unsigned rounds) {
        const render::FrameView view = frame_at(0.0, config_);
        gaze::FrameFovea fovea = render::fovea_ahead(view.views);
        for (const auto& method : methods_) {
            method->warm_up(context_, view.views);
        }
        for (unsigned round = 0; round < rounds; ++round) {
            for (const auto& method : methods_) {
                method->frame(0, view, fovea);
            }
        }
    }

    void add_figures(const std::string& lens, std::optional<double> target,
                     std::vector<Figure>& figures) const {
        const TimedMethod& full = *methods_.front();
        const render::LinearPicture reference = full.picture(context_, gaze::Eye::Left);
        const auto put = [&](const std::string& metric, double value, const char* unit,
                             const char* better) -> Figure& {
            return figures.emplace_back(
                Figure{"lightfield", case_.name, lens + metric, value, unit, better});
        };
        put("full", full.ms(), "ms", "lower");
        for (std::size_t i = 1; i < methods_.size(); ++i) {
            const TimedMethod& method = *methods_[i];
            const std::string name = method.name() == "kfr3d" ? "" : method.name() + " ";
            Figure& speedup = put(name + "speedup", full.ms() / method.ms(), "x", "higher");
            if (name.empty()) {
                speedup.target = target;
            }
            put(name + "speedup, processor", full.processor_ms() / method.processor_ms(), "x",
                "higher");
            put(name + "error", difference(method.picture(context_, gaze::Eye::Left), reference),
                "", "lower");
        }
        const TimedMethod& ours = *methods_.back();
        for (std::size_t pass = 0; pass < ours.passes().size(); ++pass) {
            put(std::string(ours.passes()[pass]), ours.pass_ms(pass), "ms", "lower");
        }
        const foveation::EyePlan& plan = ours.plan(gaze::Eye::Left);
        const methods::Kfr3dSettings set;
        const auto regions = static_cast<std::uint32_t>(set.regions);
        const double pixels = static_cast<double>(sizes_.picture_px) * sizes_.picture_px;
        const double of_full = static_cast<double>(sizes_.views) * sizes_.views * pixels;
        put("fewer samples, counted", of_full / counted_samples(plan, regions, pixels), "x",
            "higher");
        put("fewer samples, Eq. 14",
            of_full / samples_by_formula(plan, regions, pixels, std::stod(case_.sigma), set.growth),
            "x", "higher");
    }

  private:
    void add(const char* name, scene::Scene& scene, const char* method) {
        const std::vector<NamedValue> set{{"kfr.sigma", case_.sigma}};
        methods_.push_back(std::make_unique<TimedMethod>(
            context_, name, scene, tests::passes_by(method, set), config_, 1));
    }

    const vulkan::Context& context_;
    const Sizes& sizes_;
    const Case& case_;
    std::unique_ptr<scene::Scene> needed_;
    std::unique_ptr<scene::Scene> all_;
    render::RendererConfig config_;
    std::vector<std::unique_ptr<TimedMethod>> methods_;
};

/// A head that goes past the cameras, half a spacing a frame, and begins again on the left.
std::vector<double> way_across_m(const light_field::CameraGrid& cameras) {
    std::vector<double> across_m;
    const double reach_m = cameras.half_extent_m().x;
    for (double at_m = -reach_m; at_m < reach_m; at_m += cameras.spacing_m / 2.0) {
        across_m.push_back(at_m);
    }
    return across_m;
}

/// A way to keep the views, and how its frames waited.
struct Kept {
    const char* name;
    std::unique_ptr<scene::Scene> scene;
    std::unique_ptr<TimedMethod> method{};
    scene::ViewWaits before{};  ///< the first frame that is timed
};

/// What it costs to keep no more views than two lenses can ask for, and those that are on their
/// way: with frames that wait for all they lack, and with views that are fetched ahead. And what
/// BC1 loses.
void add_memory_figures(const vulkan::Context& context, const std::filesystem::path& file,
                        const Sizes& sizes, unsigned rounds, std::vector<Figure>& figures) {
    const light_field::CameraGrid cameras = value_or_throw(scene::open_light_field(file)).cameras;
    const std::uint64_t view_bytes = std::uint64_t{4} * sizes.view_px * sizes.view_px;
    // Four that frames load through, twelve that are fetched ahead, twice, and what the image takes
    // beside its views.
    constexpr std::uint32_t kBeside = 29;
    const std::uint32_t needed =
        2 * light_field::most_views({cameras, {.aperture_m = kNarrowLens_m}});
    const auto kept = [&](const char* name, const char* compression, bool whole, bool prefetch) {
        scene::SceneOptions options;
        options.light_field.aperture_m = kNarrowLens_m;
        options.light_field.compression = compression;
        options.light_field.prefetch = prefetch;
        if (!whole) {
            options.light_field.memory_mib =
                static_cast<std::int64_t>(((needed + kBeside) * view_bytes >> 20U) + 1);
        }
        return Kept{name, scene::make_scene(context, file.string(), options)};
    };
    std::vector<Kept> all;
    all.push_back(kept("resident", "none", true, false));
    all.push_back(kept("streamed", "none", false, false));
    all.push_back(kept("fetched ahead", "none", false, true));
    all.push_back(kept("bc1", "bc1", true, false));
    const Kept& resident = all.front();
    const Kept& packed = all.back();

    // Waits are the same whatever the picture's size, and show in a small one.
    const render::RendererConfig config =
        config_of({sizes.views, sizes.view_px, std::min(sizes.picture_px, kMemoryPicture_px)});
    const std::vector<double> across_m = way_across_m(cameras);
    const auto put = [&](const std::string& metric, double value, const char* unit,
                         const char* better) {
        figures.push_back({"lightfield", "memory", metric, value, unit, better});
    };
    for (const char* const name : {"full", "kfr3d"}) {
        const gaze::FrameFovea fovea = render::fovea_ahead(frame_at(0.0, config).views);
        double worst_db = std::numeric_limits<double>::max();
        for (Kept& one : all) {
            one.method = std::make_unique<TimedMethod>(
                context, name, *one.scene, tests::passes_by(name, {{"kfr.sigma", "2.0"}}), config,
                across_m.size());
            one.method->warm_up(context, frame_at(0.0, config).views);
            one.before = one.scene->view_waits();
        }
        for (unsigned round = 0; round < rounds; ++round) {
            for (std::size_t i = 0; i < across_m.size(); ++i) {
                for (const Kept& one : all) {
                    one.method->frame(i, frame_at(across_m[i], config), fovea);
                }
                if (round == 0) {
                    const auto picture = resident.method->picture(context, gaze::Eye::Left);
                    quality::Plane equal(picture.width, picture.height);
                    std::ranges::fill(equal.values, 1.0F / static_cast<float>(equal.values.size()));
                    worst_db = std::min(
                        worst_db,
                        quality::psnr_db(picture, packed.method->picture(context, gaze::Eye::Left),
                                         equal, quality::RowWork()));
                }
            }
        }
        const std::string of = fmt::format("{} ", name);
        const std::vector<double> resident_ms = resident.method->frame_elapsed_ms();
        put(of + "resident", median(resident_ms), "ms", "lower");
        for (const Kept& one : all) {
            if (&one == &resident) {
                continue;
            }
            put(of + one.name + " over resident",
                median(one.method->frame_elapsed_ms()) / median(resident_ms), "x", "lower");
            if (&one == &packed) {
                continue;
            }
            // Before the gaze is read, against the same frame whose views are all there: of the
            // first frame, after the jump, and of the others.
            std::vector<double> waits_ms = one.method->frame_begin_ms();
            const std::vector<double> none_ms = resident.method->frame_begin_ms();
            std::ranges::transform(waits_ms, none_ms, waits_ms.begin(), std::minus{});
            put(of + one.name + ", wait after a jump", waits_ms.front(), "ms", "lower");
            waits_ms.erase(waits_ms.begin());
            put(of + one.name + ", median wait", median(waits_ms), "ms", "lower");
            put(of + one.name + ", longest wait", std::ranges::max(waits_ms), "ms", "lower");
            const scene::ViewWaits waits = one.scene->view_waits();
            const double frames = static_cast<double>(rounds * across_m.size());
            put(of + one.name + ", frames that waited",
                1e2 * static_cast<double>(waits.frames - one.before.frames) / frames, "%", "lower");
            put(of + one.name + ", frames late",
                1e2 * static_cast<double>(waits.late_frames - one.before.late_frames) / frames, "%",
                "lower");
        }
        put(of + "bc1, worst picture", worst_db, "dB", "higher");
    }
    for (const Kept& one : all) {
        fmt::print(stderr, "lightfield, {}: {}\n", one.name,
                   one.scene->account().value_or("all views fit"));
    }
}

}  // namespace

std::vector<Figure> lightfield(const Options& options) {
    const vulkan::Context context({}, nullptr);
    const Sizes& sizes = options.quick ? kQuickField : kWholeField;
    const std::filesystem::path file = light_field(context, sizes);
    std::vector<Figure> figures;
    for (const Case& at : kCases) {
        if (!options.wants(at.name)) {
            continue;
        }
        Measurement wide(context, file, kWideLens_m, sizes, at);
        wide.run(options.rounds);
        wide.add_figures("", at.target, figures);
        Measurement narrow(context, file, kNarrowLens_m, sizes, at);
        narrow.run(options.rounds);
        narrow.add_figures("lens ", at.narrow_target, figures);
    }
    if (options.wants("memory")) {
        add_memory_figures(context, file, sizes, options.rounds, figures);
    }
    return figures;
}

}  // namespace gazeloop::bench

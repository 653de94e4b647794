#include <fmt/core.h>

#include <array>
#include <cmath>
#include <memory>

#include "runtime/render/frame_renderer.h"
#include "tests/bench/bench.h"

namespace gazeloop::bench {
namespace {

using latency::Pass;

/// One way to render the frame, with the durations of its rounds.
struct Contender {
    const char* name;
    render::RendererConfig config;
    std::unique_ptr<render::FrameRenderer> renderer{};
    std::vector<double> total_ms{};
    std::array<std::vector<double>, latency::kPassCount> pass_ms{};
    latency::SampleCounts counts{};
};

struct Case {
    std::uint32_t width;
    std::uint32_t height;
    double target;        ///< with the disc; a prototype's figures
    double paper_target;  ///< without it: the paper's pipeline
};
constexpr std::array kCases{Case{1920, 1080, 3.9, 2.9}, Case{2560, 1440, 4.1, 3.0},
                            Case{3840, 2160, 4.1, 3.2}};

render::FrameRequest centred_frame(const Case& at, const gaze::PerEye<render::ColorImage>& images) {
    render::FrameRequest request;
    request.scene_time_s = 2.5;
    const double aspect = static_cast<double>(at.height) / at.width;
    const double half_height = std::atan(std::tan(0.8) * aspect);
    for (const gaze::Eye eye : gaze::kEyes) {
        const std::size_t e = gaze::index(eye);
        request.views[e] = {
            .pose = {.position_m = {eye == gaze::Eye::Left ? -0.0315 : 0.0315, 0.0, 0.0}},
            .fov = {-0.8, 0.8, half_height, -half_height},
            .width_px = at.width,
            .height_px = at.height};
        request.foveae[e] = {at.width / 2.0, at.height / 2.0};
        request.targets[e] = {images[e].image(), images[e].view()};
    }
    return request;
}

void one_round(Contender& contender, const render::FrameRequest& request, bool keep) {
    contender.renderer->wait_for_slot();
    contender.counts = contender.renderer->render(request);
    contender.renderer->wait_idle();
    const auto finished = contender.renderer->next_finished();
    if (!keep || !finished) {
        return;
    }
    double total = 0.0;
    for (std::size_t pass = 0; pass < latency::kPassCount; ++pass) {
        if (finished->pass_ns[pass] >= 0) {
            const double ms = static_cast<double>(finished->pass_ns[pass]) * 1e-6;
            contender.pass_ms[pass].push_back(ms);
            total += ms;
        }
    }
    contender.total_ms.push_back(total);
}

double samples_of(const latency::SampleCounts& counts) {
    return static_cast<double>(counts.texels_shaded + counts.pixels_direct);
}

void add_figures(const std::string& name, const Contender& contender, const Contender& full,
                 double target, std::vector<Figure>& figures) {
    const double full_ms = median(full.total_ms);
    const double ms = median(contender.total_ms);
    const double resolve_ms = median(contender.pass_ms[static_cast<std::size_t>(Pass::Resolve)]);
    const double fewer = samples_of(full.counts) / samples_of(contender.counts);
    // Amdahl: the samples' share of the time shrinks with their number, the resolve comes on top.
    const double predicted = full_ms / (full_ms / fewer + resolve_ms);
    const auto add = [&](std::string metric, double value, std::string unit,
                         std::optional<double> bound, std::optional<double> goal,
                         std::string better) {
        figures.push_back({"kfr-raycast", name, std::string(contender.name) + std::move(metric),
                           value, std::move(unit), std::move(better), bound, goal});
    };
    add(" speedup", full_ms / ms, "x", fewer, target, "higher");
    add(" of Amdahl", 100.0 * full_ms / ms / predicted, "%", 100.0, 90.0, "higher");
    for (std::size_t pass = 0; pass < latency::kPassCount; ++pass) {
        if (!contender.pass_ms[pass].empty()) {
            add(fmt::format(" {}", latency::kPassNames[pass]), median(contender.pass_ms[pass]),
                "ms", std::nullopt, std::nullopt, "lower");
        }
    }
}

}  // namespace

std::vector<Figure> kfr_raycast(const Options& options) {
    const std::uint32_t samples = options.samples.value_or(16);
    const render::VulkanContext context({}, nullptr);
    std::vector<Figure> figures;
    for (const Case& at : kCases) {
        const vk::Extent2D extent(at.width, at.height);
        render::RendererConfig config;
        config.samples = samples;
        config.extents = {extent, extent};
        gaze::PerEye<render::ColorImage> images;
        for (render::ColorImage& image : images) {
            image = render::ColorImage(context, extent, config.format,
                                       vk::ImageUsageFlagBits::eColorAttachment);
        }
        std::array<Contender, 3> contenders{Contender{"full", config}, Contender{"kfr", config},
                                            Contender{"kfr, no disc", config}};
        contenders[0].config.method = render::Method::Full;
        contenders[2].config.kfr.disc = false;
        for (Contender& contender : contenders) {
            contender.renderer = std::make_unique<render::FrameRenderer>(context, contender.config);
        }
        const render::FrameRequest request = centred_frame(at, images);
        // The first round compiles.
        for (unsigned round = 0; round <= options.rounds; ++round) {
            for (Contender& contender : contenders) {
                one_round(contender, request, round > 0);
            }
        }
        const std::string name = fmt::format("{}x{}", at.width, at.height);
        figures.push_back(
            {"kfr-raycast", name, "full", median(contenders[0].total_ms), "ms", "lower"});
        add_figures(name, contenders[1], contenders[0], at.target, figures);
        add_figures(name, contenders[2], contenders[0], at.paper_target, figures);
    }
    return figures;
}

}  // namespace gazeloop::bench

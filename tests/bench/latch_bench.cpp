#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "runtime/latency/nearest_rank.h"
#include "runtime/render/off_screen.h"
#include "runtime/scene/scenes.h"
#include "runtime/time/clock.h"
#include "runtime/vulkan/clock.h"
#include "runtime/vulkan/context.h"
#include "tests/bench/bench.h"
#include "tests/support/rendered_method.h"

namespace gazeloop::bench {
namespace {

constexpr const char* kLatchBench = "latch";
constexpr const char* kHostSignal = "host-signal";
/// Of a round: with the usual three there are enough for a 99th percentile.
constexpr unsigned kFramesInRound = 34;

/// When the gaze is read.
enum class When : std::uint8_t { AtBegin, AfterSubmit, AfterGeometry };
struct Way {
    When when;
    const char* name;
};
constexpr std::array kWays{Way{When::AtBegin, "at begin"}, Way{When::AfterSubmit, "after submit"},
                           Way{When::AfterGeometry, "after G-buffer"}};

/// Times of the frames that latched in one way, ms.
struct Latched {
    std::vector<double> to_pass_i;  ///< from the latch to the first pass that needs it
    std::vector<double> to_end;     ///< from the latch to the picture's end
    std::vector<double> frame;      ///< from the frame's begin to the picture's end
    std::vector<double> geometry;   ///< passes before the gaze
    std::vector<double> planning;   ///< the host's planning, recording and submitting of the rest
};

double ranked(std::vector<double> values, double percent) {
    std::ranges::sort(values);
    const auto rank = latency::nearest_rank(percent, values.size());
    return rank ? values[*rank - 1] : std::nan("");
}

/// How soon work begins on an idle GPU: handed over, or handed over before and let go by the host's
/// signal, as passes could be that are recorded for any gaze.
class StartMeasurement {
  public:
    explicit StartMeasurement(const vulkan::Context& context)
        : context_(context),
          clock_(context),
          pool_(context.device(),
                vk::CommandPoolCreateInfo(vk::CommandPoolCreateFlagBits::eResetCommandBuffer,
                                          context.queue_family())),
          commands_(std::move(vk::raii::CommandBuffers(
              context.device(),
              vk::CommandBufferAllocateInfo(*pool_, vk::CommandBufferLevel::ePrimary, 1))[0])),
          query_(context.device(), vk::QueryPoolCreateInfo({}, vk::QueryType::eTimestamp, 1)),
          go_(make_timeline_semaphore()),
          done_(make_timeline_semaphore()) {}

    void round() {
        for (unsigned i = 0; i < kFramesInRound; ++i) {
            start(false);
            start(true);
        }
    }

    [[nodiscard]] const std::vector<double>& submitted_ms() const { return submitted_ms_; }
    [[nodiscard]] const std::vector<double>& signalled_ms() const { return signalled_ms_; }

  private:
    [[nodiscard]] vk::raii::Semaphore make_timeline_semaphore() const {
        const vk::SemaphoreTypeCreateInfo timeline(vk::SemaphoreType::eTimeline, 0);
        return {context_.device(), vk::SemaphoreCreateInfo({}, &timeline)};
    }

    void submit(bool waits) {
        using Stage = vk::PipelineStageFlagBits2;
        const vk::CommandBufferSubmitInfo commands(*commands_);
        const vk::SemaphoreSubmitInfo go(*go_, value_, Stage::eAllCommands);
        const vk::SemaphoreSubmitInfo done(*done_, value_, Stage::eAllCommands);
        context_.queue().submit2(vk::SubmitInfo2({}, waits ? 1U : 0U, &go, 1, &commands, 1, &done));
    }

    void start(bool by_signal) {
        constexpr std::chrono::milliseconds kGeometry(2);
        ++value_;
        commands_.reset();
        commands_.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
        commands_.resetQueryPool(*query_, 0, 1);
        commands_.writeTimestamp2(vk::PipelineStageFlagBits2::eTopOfPipe, *query_, 0);
        commands_.end();
        if (by_signal) {
            submit(true);
        }
        std::this_thread::sleep_for(kGeometry);  // the host waits for the G-buffer either way
        const std::int64_t from_ns = time::monotonic_ns();
        if (by_signal) {
            context_.device().signalSemaphore(vk::SemaphoreSignalInfo(*go_, value_));
        } else {
            submit(false);
        }
        (void)context_.device().waitSemaphores(vk::SemaphoreWaitInfo({}, *done_, value_),
                                               UINT64_MAX);
        const auto [result, ticks] = query_.getResult<std::uint64_t>(0, 1, sizeof(std::uint64_t),
                                                                     vk::QueryResultFlagBits::e64);
        const time::Stamp began = clock_.host_time(ticks);
        if (result == vk::Result::eSuccess && began.known()) {
            (by_signal ? signalled_ms_ : submitted_ms_)
                .push_back(static_cast<double>(began.ns - from_ns) * 1e-6);
        }
    }

    const vulkan::Context& context_;
    vulkan::GpuClock clock_;
    vk::raii::CommandPool pool_;
    vk::raii::CommandBuffer commands_;
    vk::raii::QueryPool query_;
    vk::raii::Semaphore go_;
    vk::raii::Semaphore done_;
    std::uint64_t value_ = 0;
    std::vector<double> submitted_ms_;
    std::vector<double> signalled_ms_;
};

/// Both eyes of the gallery by KFR, each finished before the next, as the loop does behind a
/// display that is faster. The same renderer latches in all ways, frame by frame in turns.
class LatchMeasurement {
  public:
    LatchMeasurement(const vulkan::Context& context, scene::Scene& scene, vk::Extent2D extent) {
        config_.extents = {extent, extent};
        targets_ = render::OffScreenTargets(context, config_.extents, config_.format);
        renderer_ = std::make_unique<render::FrameRenderer>(context, scene,
                                                            render::passes_of(config_), config_);
        const double half_rad = 50.0 * std::numbers::pi / 180.0;
        for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
            view_.views[e] = {.fov = {-half_rad, half_rad, half_rad, -half_rad},
                              .width_px = extent.width,
                              .height_px = extent.height};
        }
        view_.targets = targets_.targets();
        fovea_ = render::fovea_ahead(view_.views);
        render::warm_up(context, *renderer_, view_.views);
    }

    void round() {
        for (unsigned i = 0; i < kFramesInRound; ++i) {
            for (std::size_t way = 0; way < kWays.size(); ++way) {
                frame(kWays.at(way).when, latched_.at(way));
            }
        }
    }

    [[nodiscard]] const std::array<Latched, kWays.size()>& latched() const { return latched_; }

  private:
    void frame(When when, Latched& into) {
        ++view_.index;
        renderer_->wait_for_slot(1);
        const std::int64_t begin_ns = time::monotonic_ns();
        std::int64_t latch_ns = begin_ns;
        renderer_->begin(view_);
        if (when == When::AfterGeometry) {
            renderer_->wait_for_begun();
        }
        if (when != When::AtBegin) {
            latch_ns = time::monotonic_ns();
        }
        const std::int64_t plan_ns = time::monotonic_ns();
        renderer_->finish(fovea_);
        const std::int64_t planned_ns = time::monotonic_ns();
        renderer_->wait_idle();
        const auto gpu = renderer_->next_finished();
        const auto pass_i = renderer_->passes().find("pass_i");
        if (!gpu || !gpu->gpu_begin.known() || !pass_i || !gpu->pass_starts[*pass_i]) {
            return;
        }
        const auto ms = [](std::int64_t ns) { return static_cast<double>(ns) * 1e-6; };
        into.to_pass_i.push_back(ms(gpu->gpu_begin.ns + *gpu->pass_starts[*pass_i] - latch_ns));
        into.to_end.push_back(ms(gpu->gpu_end.ns - latch_ns));
        into.frame.push_back(ms(gpu->gpu_end.ns - begin_ns));
        into.planning.push_back(ms(planned_ns - plan_ns));
        double geometry_ms = 0.0;
        for (std::size_t pass = 0; pass < *pass_i; ++pass) {
            geometry_ms += ms(gpu->passes[pass].value_or(0));
        }
        into.geometry.push_back(geometry_ms);
    }

    render::MethodConfig config_;
    render::OffScreenTargets targets_;
    std::unique_ptr<render::FrameRenderer> renderer_;
    render::FrameView view_;
    gaze::FrameFovea fovea_;
    std::array<Latched, kWays.size()> latched_;
};

}  // namespace

std::vector<Figure> latch(const Options& options) {
    const vulkan::Context context({}, nullptr);
    const auto scene = scene::make_scene(context, "gallery");
    std::vector<Figure> figures;
    for (const vk::Extent2D extent : {vk::Extent2D(240, 270), vk::Extent2D(640, 720)}) {
        const std::string name = fmt::format("{}x{}", extent.width, extent.height);
        if (!options.wants(name)) {
            continue;
        }
        LatchMeasurement measurement(context, *scene, extent);
        for (unsigned round = 0; round < options.rounds; ++round) {
            measurement.round();
        }
        const auto add = [&](std::string metric, double value, const char* unit,
                             const char* better) -> Figure& {
            return figures.emplace_back(
                Figure{kLatchBench, name, std::move(metric), value, unit, better});
        };
        const Latched& at_begin = measurement.latched().front();
        if (at_begin.frame.empty()) {
            continue;  // the device does not relate its clock to the host's
        }
        for (std::size_t way = 0; way < kWays.size(); ++way) {
            const Latched& latched = measurement.latched().at(way);
            for (const double percent : {50.0, 99.0}) {
                if (const double age = ranked(latched.to_pass_i, percent); !std::isnan(age)) {
                    add(fmt::format("{}: age at pass I, p{:.0f}", kWays.at(way).name, percent), age,
                        "ms", "lower");
                }
            }
            add(fmt::format("{}: age at end, p50", kWays.at(way).name),
                ranked(latched.to_end, 50.0), "ms", "lower");
            add(fmt::format("{}: frame, p50", kWays.at(way).name), ranked(latched.frame, 50.0),
                "ms", "lower");
            add(fmt::format("{}: planning, p50", kWays.at(way).name),
                ranked(latched.planning, 50.0), "ms", "lower");
        }
        const Latched& late = measurement.latched().back();
        const double gained = ranked(at_begin.to_pass_i, 50.0) - ranked(late.to_pass_i, 50.0);
        add("younger at pass I, p50", gained, "ms", "higher").target =
            ranked(at_begin.geometry, 50.0);
        add("frame over latching at begin", ranked(late.frame, 50.0) / ranked(at_begin.frame, 50.0),
            "x", "lower")
            .target = 1.03;
    }
    if (options.wants(kHostSignal)) {
        // A device of its own: one that was made to wait for signals may submit otherwise.
        const vulkan::Context own({}, nullptr);
        StartMeasurement measurement(own);
        for (unsigned round = 0; round < options.rounds; ++round) {
            measurement.round();
        }
        for (const auto& [how, ms] : {std::pair("submit", &measurement.submitted_ms()),
                                      std::pair("signal", &measurement.signalled_ms())}) {
            for (const double percent : {50.0, 99.0}) {
                if (const double value = ranked(*ms, percent); !std::isnan(value)) {
                    figures.push_back({kLatchBench, kHostSignal,
                                       fmt::format("{} to begin on the GPU, p{:.0f}", how, percent),
                                       value, "ms", "lower"});
                }
            }
        }
    }
    return figures;
}

}  // namespace gazeloop::bench

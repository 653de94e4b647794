#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "runtime/session/playback.h"
#include "runtime/session/session_file.h"
#include "runtime/session/session_recorder.h"
#include "tests/support/temporary_folder.h"

namespace gazeloop::session {
namespace {

using Bits = std::vector<std::uint64_t>;

// A new member is drawn and compared below, or it is not tested.
static_assert(sizeof(gaze::GazeSample) == 376 && sizeof(gaze::FoveaPoint) == 192 &&
              sizeof(gaze::EyeView) == 96 && sizeof(frame::FrameRecord) == 1216 &&
              sizeof(frame::FrameGpuRecord) == 264);

/// Draws any content of a record from a seed. Not-a-number is the quiet one, which is what a
/// session keeps of it.
class AnyRecord {
  public:
    explicit AnyRecord(std::uint64_t seed) : random_(seed) {}

    gaze::GazeSample sample() {
        gaze::GazeSample sample;
        sample.sequence = integer();
        sample.device_ns = signed_integer();
        sample.sampled = stamp();
        sample.arrived = stamp();
        clocked(sample);
        for (gaze::EyeRay& eye : sample.eyes) {
            eye = {vector(), vector(), real(), real(), coin()};
            if (coin()) {
                eye.covariance = {1e-300, coin() ? -0.0 : -1e-7, 3.0};
            }
        }
        sample.processing =
            static_cast<gaze::GazeProcessing>(below(gaze::kGazeProcessingNames.size()));
        sample.tracker_gone = coin();
        if (coin()) {
            sample.head = pose();
        }
        return sample;
    }

    frame::FrameRecord frame(std::uint64_t index) {
        frame::FrameRecord frame;
        frame.index = index;
        auto& stamps = frame.stamps;
        stamps = {.wake_up = stamp(),
                  .begin = stamp(),
                  .latch = stamp(),
                  .filtered = {},
                  .submit = stamp(),
                  .end_frame = stamp(),
                  .gpu_begin = stamp(),
                  .gpu_end = stamp(),
                  .present = {},
                  .display = stamp(),
                  .shown = {}};
        if (stamps.latch.known() && coin()) {
            stamps.filtered = {signed_integer(), stamps.latch.kind};
        }
        frame.period_ns = signed_integer();
        frame.should_render = coin();
        frame.scene_time_s = real();
        frame.head = pose();
        for (gaze::EyeView& view : frame.views) {
            view = {pose(), {real(), real(), real(), real()}, half(), half()};
        }
        for (gaze::FoveaPoint& fovea : frame.fovea.eyes) {
            fovea = {{real(), real()},
                     vector(),
                     static_cast<gaze::FoveaState>(below(gaze::kFoveaStateNames.size())),
                     static_cast<gaze::LossReason>(below(gaze::kLossReasonNames.size())),
                     static_cast<gaze::LossCause>(below(gaze::kLossCauseNames.size())),
                     integer(),
                     stamp(),
                     stamp(),
                     {},
                     {},
                     {}};
            clocked(fovea);
            if (coin()) {
                fovea.event = static_cast<gaze::EyeEvent>(1 + below(gaze::kEyeEventNames.size()));
                fovea.horizon_ns = signed_integer();
            }
            if (coin()) {
                fovea.uncertainty_rad = coin() ? 0.0 : 1e-300;
                fovea.filter_delay_ns = signed_integer();
            }
        }
        frame.fovea.latched = stamp();
        frame.samples.grid_count = static_cast<std::uint32_t>(below(frame::kMostGrids + 1));
        for (std::size_t grid = 0; grid < frame.samples.grid_count; ++grid) {
            frame.samples.grids[grid] = {integer(), integer(), integer(), integer(), integer()};
        }
        frame.samples.pixels_output = integer();
        frame.samples.pixels_hidden = integer();
        if (coin()) {
            frame.budget_ns = signed_integer();
        }
        return frame;
    }

    frame::FrameGpuRecord gpu(std::uint64_t index) {
        frame::FrameGpuRecord gpu;
        gpu.index = index;
        gpu.gpu_begin = stamp();
        gpu.gpu_end = stamp();
        for (std::size_t pass = 0; pass < frame::kMostPasses; ++pass) {
            gpu.passes.set(pass, coin() ? std::optional(signed_integer()) : std::nullopt);
            gpu.pass_starts.set(pass, coin() ? std::optional(signed_integer()) : std::nullopt);
        }
        if (coin()) {
            gpu.pixel_hash = integer();
        }
        if (coin()) {
            gpu.clock_deviation_ns = signed_integer();
        }
        return gpu;
    }

    /// Finite: a triangle that is not is none.
    gaze::HiddenMeshes hidden() {
        const auto meshes = std::make_shared<gaze::PerEye<gaze::HiddenMesh>>();
        for (gaze::HiddenMesh& mesh : *meshes) {
            for (std::uint64_t count = below(3); count > 0; --count) {
                for (glm::dvec2& corner : mesh.emplace_back().corners) {
                    corner = {static_cast<double>(signed_integer()), coin() ? -0.0 : 1e-300};
                }
            }
        }
        return meshes;
    }

    /// Of a pose that is one.
    gaze::OriginChange origin(std::uint64_t frame) {
        return {
            .frame = frame,
            .new_in_old = {coin() ? glm::dquat{0.6, -0.0, 0.8, 0.0}
                                  : glm::dquat{0.0, 0.6, -0.0, -0.8},
                           {static_cast<double>(signed_integer()), coin() ? -0.0 : 1e-300, 0.1}},
            .announced = coin()};
    }

    bool coin() { return below(2) == 1; }

  private:
    template <typename Timed>
    void clocked(Timed& timed) {
        if (coin()) {
            timed.ready = {signed_integer(), time::StampKind::Measured};
        }
        if (coin()) {
            timed.uncertainty_ns = signed_integer();
        }
        if (coin()) {
            timed.parallax_rad = coin() ? 1e-300 : 3.0;
        }
    }

    std::uint64_t below(std::uint64_t end) { return random_() % end; }
    std::uint64_t integer() {
        constexpr std::uint64_t kMax = std::numeric_limits<std::uint64_t>::max();
        switch (below(4)) {
            case 0:
                return below(3);
            case 1:
                return kMax - below(3);
            case 2:
                return kMax / 2 + below(3);
            default:
                return random_();
        }
    }
    std::int64_t signed_integer() { return std::bit_cast<std::int64_t>(integer()); }
    std::uint32_t half() { return static_cast<std::uint32_t>(integer()); }
    double real() {
        using Limits = std::numeric_limits<double>;
        constexpr std::array kSpecial{0.0,
                                      -0.0,
                                      1.0,
                                      -3.0,
                                      9007199254740993.0,
                                      Limits::infinity(),
                                      -Limits::infinity(),
                                      Limits::quiet_NaN(),
                                      Limits::denorm_min(),
                                      Limits::max(),
                                      Limits::lowest()};
        if (coin()) {
            return kSpecial[below(kSpecial.size())];
        }
        const double any = std::bit_cast<double>(random_());
        return any == any ? any : Limits::quiet_NaN();
    }
    glm::dvec3 vector() { return {real(), real(), real()}; }
    gaze::Pose pose() { return {glm::dquat{real(), real(), real(), real()}, vector()}; }
    time::Stamp stamp() {
        return {signed_integer(), static_cast<time::StampKind>(below(time::kStampKindCount))};
    }

    std::mt19937_64 random_;
};

// Records as bits, to be compared: == would take 0.0 for -0.0 and nothing for not-a-number.

void append(Bits& bits, double value) { bits.push_back(std::bit_cast<std::uint64_t>(value)); }
void append(Bits& bits, std::int64_t value) { bits.push_back(std::bit_cast<std::uint64_t>(value)); }
void append(Bits& bits, std::uint64_t value) { bits.push_back(value); }
void append(Bits& bits, const glm::dvec3& vector) {
    append(bits, vector.x);
    append(bits, vector.y);
    append(bits, vector.z);
}
void append(Bits& bits, const gaze::Pose& pose) {
    append(bits, pose.orientation.w);
    append(bits, pose.orientation.x);
    append(bits, pose.orientation.y);
    append(bits, pose.orientation.z);
    append(bits, pose.position_m);
}
void append(Bits& bits, const time::Stamp& stamp) {
    append(bits, stamp.ns);
    append(bits, static_cast<std::uint64_t>(stamp.kind));
}

template <typename Timed>
void append_clocked(Bits& bits, const Timed& timed) {
    append(bits, timed.ready);
    append(bits, std::uint64_t{timed.uncertainty_ns.has_value()});
    append(bits, timed.uncertainty_ns.value_or(0));
    append(bits, std::uint64_t{timed.parallax_rad.has_value()});
    append(bits, timed.parallax_rad.value_or(0.0));
}

Bits bits_of(const gaze::GazeSample& sample) {
    Bits bits;
    append(bits, sample.sequence);
    append(bits, sample.device_ns);
    append(bits, sample.sampled);
    append(bits, sample.arrived);
    append_clocked(bits, sample);
    for (const gaze::EyeRay& eye : sample.eyes) {
        append(bits, eye.origin_m);
        append(bits, eye.direction);
        append(bits, eye.openness);
        append(bits, eye.confidence);
        append(bits, std::uint64_t{eye.valid});
        append(bits, std::uint64_t{eye.covariance.has_value()});
        const gaze::DirectionCovariance covariance =
            eye.covariance.value_or(gaze::DirectionCovariance{});
        append(bits, covariance.xx_rad2);
        append(bits, covariance.xy_rad2);
        append(bits, covariance.yy_rad2);
    }
    append(bits, static_cast<std::uint64_t>(sample.processing));
    append(bits, std::uint64_t{sample.tracker_gone});
    append(bits, std::uint64_t{sample.head.has_value()});
    append(bits, sample.head.value_or(gaze::Pose{}));
    return bits;
}

Bits bits_of(const gaze::OriginChange& change) {
    Bits bits;
    append(bits, change.frame);
    append(bits, std::uint64_t{change.announced});
    append(bits, change.new_in_old);
    return bits;
}

Bits bits_of(const frame::FrameRecord& frame) {
    Bits bits;
    append(bits, frame.index);
    const frame::FrameStamps& stamps = frame.stamps;
    for (const time::Stamp& stamp :
         {stamps.wake_up, stamps.begin, stamps.latch, stamps.submit, stamps.end_frame,
          stamps.gpu_begin, stamps.gpu_end, stamps.display, stamps.filtered, frame.fovea.latched}) {
        append(bits, stamp);
    }
    append(bits, frame.period_ns);
    append(bits, std::uint64_t{frame.budget_ns.has_value()});
    append(bits, frame.budget_ns.value_or(0));
    append(bits, std::uint64_t{frame.should_render});
    append(bits, frame.scene_time_s);
    append(bits, frame.head);
    for (const gaze::EyeView& view : frame.views) {
        append(bits, view.pose);
        for (const double angle :
             {view.fov.left_rad, view.fov.right_rad, view.fov.up_rad, view.fov.down_rad}) {
            append(bits, angle);
        }
        append(bits, std::uint64_t{view.width_px});
        append(bits, std::uint64_t{view.height_px});
    }
    for (const gaze::FoveaPoint& fovea : frame.fovea.eyes) {
        append(bits, fovea.position.x_px);
        append(bits, fovea.position.y_px);
        append(bits, fovea.direction);
        append(bits, static_cast<std::uint64_t>(fovea.state));
        append(bits, static_cast<std::uint64_t>(fovea.reason));
        append(bits, static_cast<std::uint64_t>(fovea.cause));
        append(bits, fovea.sample_sequence);
        append(bits, fovea.sampled);
        append(bits, fovea.arrived);
        append_clocked(bits, fovea);
        append(bits, fovea.event ? static_cast<std::uint64_t>(*fovea.event) : 0);
        append(bits, std::uint64_t{fovea.horizon_ns.has_value()});
        append(bits, fovea.horizon_ns.value_or(0));
        append(bits, std::uint64_t{fovea.uncertainty_rad.has_value()});
        append(bits, fovea.uncertainty_rad.value_or(0.0));
        append(bits, std::uint64_t{fovea.filter_delay_ns.has_value()});
        append(bits, fovea.filter_delay_ns.value_or(0));
    }
    const frame::SampleCounts& samples = frame.samples;
    append(bits, std::uint64_t{samples.grid_count});
    for (const frame::GridCounts& grid : samples.grids) {
        for (const std::uint64_t count :
             {grid.planned, grid.shaded, grid.off_screen, grid.covered, grid.hidden}) {
            append(bits, count);
        }
    }
    append(bits, samples.pixels_output);
    append(bits, samples.pixels_hidden);
    return bits;
}

Bits bits_of(const frame::FrameGpuRecord& gpu) {
    Bits bits;
    append(bits, gpu.index);
    append(bits, gpu.gpu_begin);
    append(bits, gpu.gpu_end);
    for (std::size_t pass = 0; pass < frame::kMostPasses; ++pass) {
        append(bits, std::uint64_t{gpu.passes[pass].has_value()});
        append(bits, gpu.passes[pass].value_or(0));
        append(bits, std::uint64_t{gpu.pass_starts[pass].has_value()});
        append(bits, gpu.pass_starts[pass].value_or(0));
    }
    append(bits, std::uint64_t{gpu.clock_deviation_ns.has_value()});
    append(bits, gpu.clock_deviation_ns.value_or(0));
    append(bits, std::uint64_t{gpu.pixel_hash.has_value()});
    append(bits, gpu.pixel_hash.value_or(0));
    return bits;
}

RC_GTEST_PROP(Session, ComesBackBitForBit,
              (std::uint64_t seed, std::set<std::uint64_t> numbers,
               const std::map<std::string, std::string>& config)) {
    // Frame numbers are drawn apart, because they are unique; both ends of the range take part.
    numbers.insert({0, std::numeric_limits<std::uint64_t>::max()});
    AnyRecord any(seed);
    std::vector<RecordedSample> samples;
    std::vector<RecordedFrame> frames;
    std::vector<gaze::HiddenChange> hidden;
    std::vector<gaze::OriginChange> origins;

    const tests::TemporaryFolder folder;
    const std::filesystem::path file = folder / "run.session";
    SessionHeader header;
    for (const auto& [name, value] : config) {
        header.config.push_back({name, value});
    }
    const auto recorder = value_or_throw(SessionRecorder::create(file, header));
    for (const std::uint64_t number : numbers) {
        samples.push_back({number, any.sample()});
        samples.push_back({number, any.sample()});
        RecordedFrame frame{any.frame(number), {}};
        frame.gpu.index = number;
        recorder->add(samples[samples.size() - 2].sample, number);
        recorder->add(samples.back().sample, number);
        hidden.push_back({number, any.hidden()});
        recorder->add(hidden.back());
        origins.push_back(any.origin(number));
        recorder->add(origins.back());
        recorder->add(frame.frame);
        if (any.coin()) {
            frame.gpu = any.gpu(number);
            recorder->add(frame.gpu);
        }
        frames.push_back(frame);
    }
    RC_ASSERT(recorder->close().complete());

    const SessionFile session = value_or_throw(read_session(file));
    RC_ASSERT(session.header.config.size() == header.config.size());
    for (std::size_t i = 0; i < header.config.size(); ++i) {
        RC_ASSERT(session.header.config[i].name == header.config[i].name);
        RC_ASSERT(session.header.config[i].value == header.config[i].value);
    }
    RC_ASSERT(session.samples.size() == samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        RC_ASSERT(session.samples[i].frame == samples[i].frame);
        RC_ASSERT(bits_of(session.samples[i].sample) == bits_of(samples[i].sample));
    }
    RC_ASSERT(session.hidden.size() == hidden.size());
    for (std::size_t i = 0; i < hidden.size(); ++i) {
        RC_ASSERT(session.hidden[i].frame == hidden[i].frame);
        RC_ASSERT(*session.hidden[i].meshes == *hidden[i].meshes);
    }
    RC_ASSERT(session.origins.size() == origins.size());
    for (std::size_t i = 0; i < origins.size(); ++i) {
        RC_ASSERT(bits_of(session.origins[i]) == bits_of(origins[i]));
    }
    RC_ASSERT(session.frames.size() == frames.size());
    for (std::size_t i = 0; i < frames.size(); ++i) {
        RC_ASSERT(bits_of(session.frames[i].frame) == bits_of(frames[i].frame));
        RC_ASSERT(bits_of(session.frames[i].gpu) == bits_of(frames[i].gpu));
    }
}

/// What an observer is told, as bits: the live loop's calls and those of a playback are compared.
class Told final : public frame::FrameObserver {
  public:
    void on_hidden(const gaze::HiddenChange& change) override {
        Bits& call = calls.emplace_back(Bits{0, change.frame});
        for (const gaze::HiddenMesh& mesh : *change.meshes) {
            append(call, std::uint64_t{mesh.size()});
            for (const gaze::HiddenTriangle& triangle : mesh) {
                for (const glm::dvec2& corner : triangle.corners) {
                    append(call, corner.x);
                    append(call, corner.y);
                }
            }
        }
    }
    void on_origin(const gaze::OriginChange& change) override {
        add(4, change.frame, bits_of(change));
    }
    void on_sample(const gaze::GazeSample& sample, std::uint64_t frame) override {
        add(1, frame, bits_of(sample));
    }
    void on_frame(const frame::FrameRecord& record) override { add(2, 0, bits_of(record)); }
    void on_gpu(const frame::FrameGpuRecord& record) override { add(3, 0, bits_of(record)); }

    std::vector<Bits> calls;

  private:
    void add(std::uint64_t kind, std::uint64_t frame, const Bits& bits) {
        Bits& call = calls.emplace_back(Bits{kind, frame});
        call.insert(call.end(), bits.begin(), bits.end());
    }
};

RC_GTEST_PROP(Session, IsPlayedAsItWasTold, (std::uint64_t seed, std::set<std::uint64_t> numbers)) {
    numbers.insert({0, std::numeric_limits<std::uint64_t>::max()});
    AnyRecord any(seed);
    const tests::TemporaryFolder folder;
    const std::filesystem::path file = folder / "run.session";
    const auto recorder = value_or_throw(SessionRecorder::create(file, {}));
    Told live;
    for (const std::uint64_t number : numbers) {
        if (any.coin()) {
            const gaze::HiddenChange change{number, any.hidden()};
            recorder->add(change);
            live.on_hidden(change);
        }
        if (any.coin()) {
            const gaze::OriginChange change = any.origin(number);
            recorder->add(change);
            live.on_origin(change);
        }
        while (any.coin()) {
            const gaze::GazeSample sample = any.sample();
            recorder->add(sample, number);
            live.on_sample(sample, number);
        }
        const frame::FrameRecord frame = any.frame(number);
        recorder->add(frame);
        live.on_frame(frame);
        if (any.coin()) {
            const frame::FrameGpuRecord gpu = any.gpu(number);
            recorder->add(gpu);
            live.on_gpu(gpu);
        }
    }
    RC_ASSERT(recorder->close().complete());

    Told played;
    const std::array<frame::FrameObserver*, 1> observers{&played};
    const PlaybackEnd end = value_or_throw(play(file, observers));
    RC_ASSERT(end.last_frame == std::optional(*numbers.rbegin()));
    RC_ASSERT(played.calls == live.calls);
}

}  // namespace
}  // namespace gazeloop::session

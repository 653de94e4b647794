// What texels that take turns promise: all of them after as many frames as a block has texels, a
// picture of more rays where nothing moves, and nothing of the past where that does not fit.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <limits>

#include "runtime/render/cut.h"
#include "runtime/render/passes/interleaved_passes.h"
#include "runtime/render/passes/log_polar_passes.h"
#include "tests/support/frame_renderer_fixture.h"

namespace gazeloop::render {
namespace {

foveation::KfrParameters tall() { return {.aspect = 0.35}; }

/// The same LP-buffer, all texels in every frame.
MakePasses whole() {
    return [](const PassSetup& setup) { return make_kfr_passes(setup, tall()); };
}

MakePasses interleaved(const InterleavedConfig& config = {}) {
    return
        [config](const PassSetup& setup) { return make_interleaved_passes(setup, config, tall()); };
}

class Interleaved : public FrameRendererTest {
  protected:
    static RendererConfig pictures(std::uint32_t samples = 1) {
        RendererConfig config;
        config.samples = samples;
        config.extents = {vk::Extent2D(160, 120), vk::Extent2D(160, 120)};
        config.hash = true;
        return config;
    }

    static FrameRequest looking_at(gaze::PixelPosition fovea) {
        MethodConfig sized;
        sized.extents = pictures().extents;
        return request(sized, fovea);
    }

    static FrameRequest turned(FrameRequest at, double yaw_deg) {
        for (gaze::EyeView& view : at.views) {
            view.pose.orientation = glm::angleAxis(glm::radians(yaw_deg), glm::dvec3(0, 1, 0));
        }
        return at;
    }

    /// Frames by one renderer, one after the other.
    class Run {
      public:
        explicit Run(const MakePasses& passes, std::uint32_t samples = 1)
            : off_screen_(context(), scene(), passes, pictures(samples)) {}

        std::optional<std::uint64_t> next(FrameRequest request) {
            request.index = index++;
            const auto rendered = off_screen_.render(request.frame_view(), request.fovea());
            shaded_ = rendered.counts.shaded();
            return rendered.gpu.pixel_hash;
        }
        /// Cells of the last frame.
        [[nodiscard]] std::uint64_t shaded() const { return shaded_; }
        Picture after(const FrameRequest& request, int frames) {
            for (int frame = 0; frame < frames; ++frame) {
                next(request);
            }
            return off_screen_.picture(gaze::Eye::Left);
        }
        std::uint64_t index = 0;

      private:
        OffScreen off_screen_;
        std::uint64_t shaded_ = 0;
    };

    /// Root of the mean square, codes.
    static double difference(const Picture& a, const Picture& b) {
        double sum = 0.0;
        for (std::size_t i = 0; i < a.pixels.size(); ++i) {
            for (std::size_t c = 0; c < 3; ++c) {
                sum += std::pow(a.pixels[i][c] - b.pixels[i][c], 2.0);
            }
        }
        return std::sqrt(sum / (3.0 * static_cast<double>(a.pixels.size())));
    }
};

// Where nothing moves and no sample is moved, each texel is shaded as if all were.
TEST_F(Interleaved, HasEveryTexelAfterAsManyFramesAsThereAreTurns) {
    const FrameRequest at = looking_at({90, 50});
    const Picture expected = Run(whole()).after(at, 1);
    for (const std::uint32_t every : foveation::CellTurns::kEvery) {
        Run run(interleaved(
            {.texels = {every}, .pixels = {every}, .visits = 1, .jitter = false, .refill = false}));
        const int turns = static_cast<int>(every);
        if (turns > 1) {
            EXPECT_GT(difference(run.after(at, turns - 1), expected), 0.5) << every;
        }
        // Halves in the one, not in the other, may round the other way.
        EXPECT_LE(largest_difference(run.after(at, 1), expected), 1) << every;
        EXPECT_LE(largest_difference(run.after(at, 1), expected), 1)
            << every << ", one frame later";
    }
}

TEST_F(Interleaved, ShadesOnePartOfTheTexels) {
    const FrameRequest at = looking_at({80, 60});
    const auto shaded = [&](std::uint32_t every) {
        Run run(interleaved({.texels = {every}, .pixels = {every}}));
        run.next(at);
        run.next(at);
        return static_cast<double>(run.shaded());
    };
    for (const std::uint32_t every : {2U, 4U, 8U}) {
        EXPECT_NEAR(shaded(1) / shaded(every), every, 0.15 * every) << every;
    }
}

// Where nothing is kept, the frame is that of the whole method.
TEST_F(Interleaved, ShadesEveryTexelWhereNothingIsKept) {
    const FrameRequest at = looking_at({90, 50});
    Run all(whole());
    const Picture expected = all.after(at, 1);
    for (const std::uint32_t every : foveation::CellTurns::kEvery) {
        Run run(interleaved({.texels = {every}, .pixels = {every}, .jitter = false}));
        run.index = 5;
        // Halves in the one, not in the other, may round the other way.
        EXPECT_LE(largest_difference(run.after(at, 1), expected), 1) << every;
        EXPECT_LE(largest_difference(run.after(at, 1), expected), 1) << every << ", then its turn";
        EXPECT_LT(run.shaded() * every, 1.3 * static_cast<double>(all.shaded())) << every;
    }
}

// After a saccade the disc is as good as that of a first frame, by the samples of what lay outside.
TEST_F(Interleaved, ShadesWhatTheGazeLandsOn) {
    const FrameRequest before = looking_at({50, 60});
    const FrameRequest after = looking_at({110, 60});
    const auto landed = [&](bool refill) {
        Run run(interleaved({.texels = {8}, .pixels = {8}, .refill = refill}), 4);
        run.after(before, 16);
        return std::pair{run.after(after, 1), run.shaded()};
    };
    const Picture more_rays = Run(whole(), 16).after(after, 1);
    const auto [refilled, samples] = landed(true);
    const auto [kept, fewest] = landed(false);
    EXPECT_LT(difference(refilled, more_rays), 0.85 * difference(kept, more_rays));
    EXPECT_GT(samples, fewest);
    Run all(whole(), 4);
    all.next(after);
    EXPECT_LT(samples, all.shaded());
}

// Gaze that only drifts asks for no more samples.
TEST_F(Interleaved, ShadesNoMoreWhereTheGazeDrifts) {
    Run run(interleaved());
    run.next(looking_at({80.0, 60.0}));
    run.next(looking_at({80.5, 60.0}));
    const std::uint64_t drifting = run.shaded();
    Run still(interleaved());
    still.next(looking_at({80.5, 60.0}));
    still.next(looking_at({80.5, 60.0}));
    EXPECT_EQ(drifting, still.shaded());
}

TEST_F(Interleaved, ConvergesToThePictureOfMoreRays) {
    const FrameRequest at = looking_at({80, 60});
    const Picture more_rays = Run(whole(), 16).after(at, 1);
    Run run(interleaved(), 4);
    const double first = difference(run.after(at, 4), more_rays);
    const double last = difference(run.after(at, 60), more_rays);
    EXPECT_LT(last, 0.8 * first);
    EXPECT_LT(last, difference(Run(whole(), 4).after(at, 1), more_rays));
}

// As the eye turns and the gaze moves, what is kept stays with what it shows.
TEST_F(Interleaved, KeepsWhatItShowsWhereItIs) {
    const auto at_frame = [](int frame) {
        return turned(looking_at({80.0 + frame, 60.0}), 0.4 * frame);
    };
    const auto last_of = [&](const InterleavedConfig& config) {
        Run run(interleaved(config), 4);
        for (int frame = 0; frame < 11; ++frame) {
            run.next(at_frame(frame));
        }
        return run.after(at_frame(11), 1);
    };
    const Picture now = Run(whole(), 16).after(at_frame(11), 1);
    const double followed = difference(last_of({}), now);
    EXPECT_LT(followed, 0.9 * difference(last_of({.follow = false}), now));
    // Better than what this frame alone shows.
    EXPECT_LT(followed,
              difference(Run(interleaved({.refill = false}), 4).after(at_frame(11), 1), now));
}

// Where the picture moves over the pixels, what is kept of the disc is not washed out.
TEST_F(Interleaved, KeepsTheDiscSharpAsTheEyeTurns) {
    const auto at_frame = [](int frame) { return turned(looking_at({80, 60}), 0.25 * frame); };
    const auto last_of = [&](InterleavedConfig::Sharp sharp) {
        // The gaze stays in the picture, so that what it shows moves through the disc.
        Run run(interleaved({.texels = {8}, .pixels = {8}, .sharp = sharp}), 4);
        for (int frame = 0; frame < 9; ++frame) {
            run.next(at_frame(frame));
        }
        return run.after(at_frame(9), 1);
    };
    const Picture now = Run(whole(), 16).after(at_frame(9), 1);
    const double sharp = difference(last_of(InterleavedConfig::Sharp::Disc), now);
    EXPECT_LT(sharp, difference(last_of(InterleavedConfig::Sharp::Nothing), now));
}

// What moves by itself leaves nothing behind that the next visit of every texel does not take.
TEST_F(Interleaved, LeavesNoGhostOfWhatMoved) {
    FrameRequest before = looking_at({80, 60});
    FrameRequest after = before;
    after.scene_time_s = before.scene_time_s + 1.0;
    const Picture there = Run(whole(), 16).after(before, 1);
    const Picture gone = Run(whole(), 16).after(after, 1);
    ASSERT_GT(difference(there, gone), 4.0) << "nothing moves in a second";
    Run run(interleaved(), 4);
    run.after(before, 40);
    const double first = difference(run.after(after, 1), gone);
    const double settled = difference(run.after(after, 4), gone);
    const double fresh = difference(Run(interleaved(), 4).after(after, 4), gone);
    EXPECT_LT(first, difference(Run(interleaved(), 4).after(after, 1), gone));
    EXPECT_LT(settled, 1.25 * fresh + 0.5);
}

TEST_F(Interleaved, ForgetsAtACutAndWhereAFrameWasLeftOut) {
    const FrameRequest here = looking_at({80, 60});
    const FrameRequest elsewhere = turned(here, 90.0);
    Run cut(interleaved());
    cut.after(here, 5);
    Run new_there(interleaved());
    new_there.index = cut.index;
    EXPECT_EQ(cut.next(elsewhere), new_there.next(elsewhere));
    Run left_out(interleaved());
    left_out.after(here, 5);
    left_out.index += 3;
    Run new_here(interleaved());
    new_here.index = left_out.index;
    EXPECT_EQ(left_out.next(here), new_here.next(here));
}

TEST_F(Interleaved, GivesTheSameFramesAgain) {
    Run first(interleaved(), 2);
    Run second(interleaved(), 2);
    for (int frame = 0; frame < 9; ++frame) {
        const FrameRequest at = turned(looking_at({60.0 + 9.0 * frame, 60.0}), 0.3 * frame);
        const auto hash = first.next(at);
        ASSERT_TRUE(hash.has_value());
        EXPECT_EQ(second.next(at), hash) << frame;
    }
}

TEST(InterleavedCut, IsAJumpOfPlaceDirectionOrTime) {
    const CutPlace here{.pose = {}, .scene_time_s = 1.0};
    EXPECT_FALSE(is_cut(here, here));
    CutPlace other = here;
    other.pose.position_m = {0.4, 0.0, 0.0};
    other.pose.orientation = -glm::angleAxis(0.6, glm::dvec3(0, 1, 0));
    other.scene_time_s = 2.5;
    EXPECT_FALSE(is_cut(here, other));
    other.pose.position_m.x = 0.6;
    EXPECT_TRUE(is_cut(here, other));
    other = here;
    other.pose.orientation = glm::angleAxis(0.8, glm::dvec3(1, 0, 0));
    EXPECT_TRUE(is_cut(here, other));
    other = here;
    other.scene_time_s = -1.5;
    EXPECT_TRUE(is_cut(here, other));
    other.scene_time_s = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(is_cut(here, other));
}

}  // namespace
}  // namespace gazeloop::render

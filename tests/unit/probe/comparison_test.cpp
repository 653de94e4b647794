#include "runtime/probe/comparison.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "sim/random.h"

namespace gazeloop::probe {
namespace {

using testing::HasSubstr;
using Json = nlohmann::json;

constexpr double kMs = 1e6;

Json result() {
    const Json delays{{"trials", 24},
                      {"mean_ms", 46.5},
                      {"uncertain_ms", 1.25},
                      {"min_ms", 40},
                      {"max_ms", 53.125}};
    return {{"format", "gazeloop-probe"},  {"version", 1},
            {"eye_lost", delays},          {"eye_found", {{"trials", 0}, {"mean_ms", nullptr}}},
            {"patch", {{"pulsed", true}}}, {"warnings", {"the lamp is overexposed"}}};
}

TEST(Measurement, IsReadAsWritten) {
    const auto read = parse_measurement(result().dump(), "r.json");
    ASSERT_TRUE(read.has_value()) << read.error().message;
    EXPECT_EQ(read->eye_lost->trials, 24U);
    EXPECT_EQ(read->eye_lost->mean_ms, 46.5);
    EXPECT_EQ(read->eye_lost->uncertain_ms, 1.25);
    EXPECT_FALSE(read->eye_found);
    EXPECT_TRUE(read->pulsed);
    EXPECT_EQ(read->source, "r.json");
    EXPECT_THAT(read->warnings, testing::ElementsAre("the lamp is overexposed"));
    const std::string text =
        comparison_text({.measured = *read, .modelled = {}, .begin_to_middle_ms = std::nullopt});
    EXPECT_THAT(text, HasSubstr("warning     the lamp is overexposed"));
}

TEST(Measurement, WhatCannotBeIsNamed) {
    const auto refusal = [](const std::string& text) {
        const auto read = parse_measurement(text, "r.json");
        EXPECT_FALSE(read.has_value()) << text;
        return read ? "" : read.error().message;
    };
    EXPECT_THAT(refusal(""), HasSubstr("r.json: is no result of gazeloop probe"));
    EXPECT_THAT(refusal("[]"), HasSubstr("not a JSON object"));
    const auto with = [](const char* path, const Json& value) {
        Json json = result();
        json[Json::json_pointer(path)] = value;
        return json.dump();
    };
    EXPECT_THAT(refusal(with("/format", "other")), HasSubstr("'format' is another"));
    EXPECT_THAT(refusal(with("/warnings", 3)), HasSubstr("'/warnings' are no texts"));
    EXPECT_THAT(refusal(with("/version", 2)), HasSubstr("'version' is not 1"));
    EXPECT_THAT(refusal(with("/eye_lost/trials", -1)), HasSubstr("'/eye_lost/trials' is no count"));
    EXPECT_THAT(refusal(with("/eye_lost/mean_ms", "46")), HasSubstr("'/eye_lost/mean_ms' is no"));
    EXPECT_THAT(refusal(with("/eye_lost/mean_ms", 1e300)), HasSubstr("'/eye_lost/mean_ms' is no"));
    EXPECT_THAT(refusal(with("/eye_lost/mean_ms", 99)), HasSubstr("lies outside its trials"));
    EXPECT_THAT(refusal(with("/eye_lost/uncertain_ms", -1)), HasSubstr("is negative"));
    EXPECT_THAT(refusal(with("/patch/pulsed", 1)), HasSubstr("neither true nor false"));
    Json lacking = result();
    lacking.erase("eye_found");
    EXPECT_THAT(refusal(lacking.dump()), HasSubstr("it lacks '/eye_found/trials'"));
}

frame::FrameRecord frame(std::uint64_t index, double sampled_ns, double display_ns) {
    frame::FrameRecord record;
    record.index = index;
    for (gaze::FoveaPoint& point : record.fovea.eyes) {
        point.state = gaze::FoveaState::Tracking;
        point.sampled = {std::llround(sampled_ns), time::StampKind::Profile};
    }
    record.stamps.display = {std::llround(display_ns), time::StampKind::Predicted};
    return record;
}

// Events at random moments, followed one by one through the same samples and frames.
TEST(EventToPhotonModel, IsWhatEventsAtAnyMomentSee) {
    struct Shown {
        double sampled_ns;
        double display_ns;
    };
    std::vector<Shown> shown;
    EventToPhotonModel model(std::nullopt, 0);
    const double sample_every = 8.3 * kMs;
    for (std::uint64_t i = 0; i < 2000; ++i) {
        const double display = 11.1 * kMs * static_cast<double>(i + 4);
        const double latch = display - 14.0 * kMs;
        const double sampled = std::floor((latch - 9.0 * kMs) / sample_every) * sample_every;
        model.on_frame(frame(i, sampled, display));
        shown.push_back({sampled, display});
    }
    sim::Random random(5, sim::Stream::Targets);
    double sum = 0.0;
    double squares = 0.0;
    constexpr int kEvents = 200'000;
    for (int i = 0; i < kEvents; ++i) {
        const double event = random.uniform(shown[1].sampled_ns, shown[1900].sampled_ns);
        const auto first = std::ranges::lower_bound(shown, event, {}, &Shown::sampled_ns);
        const double delay_ms = (first->display_ns - event) / kMs;
        sum += delay_ms;
        squares += delay_ms * delay_ms;
    }
    const EventToPhoton result = model.result();
    const double mean = sum / kEvents;
    EXPECT_NEAR(*result.mean_ms, mean, 0.05);
    EXPECT_NEAR(*result.sd_ms, std::sqrt(squares / kEvents - mean * mean), 0.05);
    EXPECT_EQ(result.kind, time::StampKind::Predicted);
}

TEST(EventToPhotonModel, KnowsNothingOfNothing) {
    EventToPhotonModel model(1000, 11'000'000);
    model.on_frame(frame(0, 0.0, 20 * kMs));
    const EventToPhoton result = model.result();
    EXPECT_EQ(result.frames, 0U);
    EXPECT_FALSE(result.mean_ms || result.sd_ms);
    EXPECT_EQ(result.kind, time::StampKind::Unknown);
}

Comparison comparison(double measured_ms, std::optional<double> modelled_ms) {
    return {.measured = {.source = "r.json",
                         .eye_lost = MeasuredDelay{.trials = 20,
                                                   .mean_ms = measured_ms,
                                                   .uncertain_ms = 1.0,
                                                   .min_ms = 30,
                                                   .max_ms = 60},
                         .eye_found = std::nullopt,
                         .pulsed = false},
            .modelled = {.frames = 100,
                         .mean_ms = modelled_ms,
                         .sd_ms = 3.0,
                         .kind = time::StampKind::Profile},
            .begin_to_middle_ms = 2.0};
}

TEST(Comparison, SaysByHowMuchTheyDiffer) {
    EXPECT_NEAR(*comparison(45.0, 44.0).longer_by_ms(), 3.0, 1e-12);
    EXPECT_THAT(comparison_text(comparison(45.0, 44.0)),
                HasSubstr("3.0 ms longer than modelled, more than its uncertainty: tracker"));
    EXPECT_THAT(comparison_text(comparison(40.0, 44.0)),
                HasSubstr("2.0 ms shorter than modelled, more than its uncertainty: a profile"));
    EXPECT_THAT(comparison_text(comparison(42.5, 44.0)), HasSubstr("within the measurement's"));
    EXPECT_THAT(comparison_text(comparison(42.5, std::nullopt)), HasSubstr("modelled    unknown"));
    EXPECT_EQ(comparison_json(comparison(42.5, std::nullopt))["longer_than_modelled_ms"], nullptr);
    Comparison none = comparison(42.5, 44.0);
    none.measured.eye_lost.reset();
    EXPECT_THAT(comparison_text(none), HasSubstr("nothing was measured"));
    EXPECT_EQ(comparison_json(none)["measured"], nullptr);
}

}  // namespace
}  // namespace gazeloop::probe

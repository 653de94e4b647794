#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "runtime/gaze/gaze_motion.h"
#include "runtime/report/lag_loss.h"
#include "runtime/report/lag_reasons.h"
#include "runtime/report/recorded_application.h"
#include "runtime/time/milliseconds.h"

// The rules of the paragraph. Each sentence stands alone and names what it speaks of.

namespace gazeloop::report {
namespace {

using latency::DurationRow;
using latency::Stage;
using latency::Verdict;

const DurationRow& row_of(const LagFacts& facts, Stage stage) {
    return facts.report->stages[static_cast<std::size_t>(stage)];
}
const DurationRow& age_of(const LagFacts& facts) { return facts.report->gaze_age_at_display; }

bool has_age(const LagFacts& facts) { return dearest_stage(*facts.report).has_value(); }

template <Stage kStage>
bool dearest_is(const LagFacts& facts) {
    const auto dearest = dearest_stage(*facts.report);
    return dearest && dearest->stage == kStage;
}

bool dearest_is_unaccounted(const LagFacts& facts) {
    const auto dearest = dearest_stage(*facts.report);
    return dearest && !dearest->stage;
}

double period_ms(const LagFacts& facts) {
    return static_cast<double>(facts.report->config.period_ns) / time::kNsPerMs;
}

/// " (now 1.8)"; empty where the setting is not known.
std::string now(const LagFacts& facts, std::string_view setting) {
    const std::string_view value = facts.setting(setting);
    return value.empty() ? "" : fmt::format(" (now {})", value);
}

/// What makes the GPU's work less, by the method that was used.
std::string less_gpu_work(const LagFacts& facts) {
    if (is_of_another_program(facts)) {
        return fmt::format("a lower resolution or quality in {}, or of the runtime's pictures",
                           facts.device_value("application"));
    }
    const std::string_view method = facts.setting("render.method");
    std::string scale = "a lower render.scale" + now(facts, "render.scale");
    if (method == "full") {
        return "--method kfr, which shades fewer samples, or " + scale;
    }
    if (method == "kfr") {
        return "a higher kfr.sigma" + now(facts, "kfr.sigma") + ", or " + scale;
    }
    if (method == "acuity") {
        return "a higher acuity.mar" + now(facts, "acuity.mar") + ", or " + scale;
    }
    return scale;
}

/// The pass that takes longest on average: "; its dearest pass is disc with 3.1 ms".
std::string dearest_pass(const LagFacts& facts) {
    const latency::SummaryReport& report = *facts.report;
    std::size_t dearest = report.passes.size();
    for (std::size_t pass = 0; pass < report.config.passes.size(); ++pass) {
        if (report.passes[pass].mean_ms.value_or(0.0) >
            (dearest < report.passes.size() ? *report.passes[dearest].mean_ms : 0.0)) {
            dearest = pass;
        }
    }
    return dearest == report.passes.size()
               ? ""
               : fmt::format("; its dearest pass is {} with {}", report.config.passes[dearest],
                             milliseconds_text(*report.passes[dearest].mean_ms));
}

/// "Most of it, 30.0 ms (66 %), passes"; the largest part where it is less than half.
std::string cost(const LagFacts& facts, std::string_view where) {
    const DearestStage dearest = *dearest_stage(*facts.report);
    return fmt::format("{} of it, {} ({:.0f} %), passes {}.",
                       dearest.percent > 50.0 ? "Most" : "The largest part",
                       milliseconds_text(dearest.mean_ms), dearest.percent, where);
}

/// "the gaze is 45.2 ms old when it is seen (52.0 ms or less in 95 % of the frames)".
std::string age_text(const LagFacts& facts) {
    const DurationRow& age = age_of(facts);
    const std::string spread =
        age.p95_ms ? fmt::format("{} or less in 95 % of the frames", milliseconds_text(*age.p95_ms))
                   : fmt::format("at most {}", milliseconds_text(*age.max_ms));
    return fmt::format("the gaze is {} old when its picture is seen ({})",
                       milliseconds_text(*age.mean_ms), spread);
}

// Standing.

constexpr std::array kStanding{
    LagRule{"no-frames", [](const LagFacts& f) { return f.report->frames.rendered == 0; },
            [](const LagFacts& f) {
                return f.report->frames.total == 0
                           ? std::string("There is no frame, so nothing is known of its latency.")
                           : fmt::format(
                                 "None of the {} frames was rendered, so nothing is known "
                                 "of their latency.",
                                 f.report->frames.total);
            }},
    LagRule{"no-gaze", [](const LagFacts& f) { return f.report->frames.with_gaze() == 0; },
            [](const LagFacts& f) {
                return fmt::format("The fovea had no fresh gaze to follow in any of the {} frames.",
                                   f.report->frames.rendered);
            }},
    LagRule{"age-unknown", [](const LagFacts& f) { return age_of(f).count == 0; },
            [](const LagFacts& f) {
                return fmt::format(
                    "How old the gaze is when its picture is seen is unknown in all "
                    "of the {} frames with gaze.",
                    f.report->frames.with_gaze());
            }},
    LagRule{"age-not-positive", [](const LagFacts& f) { return !has_age(f); },
            [](const LagFacts& f) {
                return fmt::format(
                    "By its stamps the gaze is {} old when its picture is seen, "
                    "which cannot be: a clock is wrong.",
                    milliseconds_text(age_of(f).mean_ms.value_or(0.0)));
            }},
    LagRule{"virtual-time",
            [](const LagFacts& f) { return f.report->verdict == Verdict::VirtualTime; },
            [](const LagFacts& f) {
                return "Nothing was timed: this is virtual time, and the loop's durations are "
                       "modelled. By the model " +
                       age_text(f) + ".";
            }},
    LagRule{"not-in-time",
            [](const LagFacts& f) {
                return f.report->verdict == Verdict::NotRealTime &&
                       f.report->frame_interval.p50_ms.value_or(0.0) <= 1.05 * period_ms(f);
            },
            [](const LagFacts& f) {
                return fmt::format(
                    "The machine does not keep up: {:.1f} % of the frames miss "
                    "their display time. So these are not a headset's ages: on "
                    "average {}.",
                    f.report->missed_percent().value_or(0.0), age_text(f));
            }},
    LagRule{"not-real-time",
            [](const LagFacts& f) { return f.report->verdict == Verdict::NotRealTime; },
            [](const LagFacts& f) {
                return fmt::format(
                    "The machine does not keep up: a frame comes every {}, the "
                    "display shows one every {}. So these are not a headset's ages: "
                    "on average {}.",
                    milliseconds_text(f.report->frame_interval.p50_ms.value_or(0.0)),
                    milliseconds_text(period_ms(f)), age_text(f));
            }},
    LagRule{"timed", [](const LagFacts&) { return true; },
            [](const LagFacts& f) { return "On average " + age_text(f) + "."; }},
};

// Loss.

constexpr std::array kLoss{LagRule{"often-lost", often_lost, loss_sentence}};

// Cost.

bool filters_gaze(const LagFacts& facts) {
    const std::string_view filter = facts.setting("gaze.filter");
    return !filter.empty() && filter != gaze::name(gaze::GazeFilter::None);
}

constexpr std::array kCost{
    LagRule{"cost-tracker", dearest_is<Stage::Tracker>,
            [](const LagFacts& f) {
                const bool constant = row_of(f, Stage::Tracker).kind() == time::StampKind::Profile;
                return cost(f, constant ? "in the tracker (a constant of its profile, not measured)"
                                        : "in the tracker");
            }},
    LagRule{"cost-delivery", dearest_is<Stage::Delivery>,
            [](const LagFacts& f) { return cost(f, "on the way from the tracker to the host"); }},
    LagRule{"cost-queue", dearest_is<Stage::Queue>,
            [](const LagFacts& f) {
                return cost(f, is_of_another_program(f)
                                   ? "while the sample waits to be read"
                                   : "while the sample waits for the loop to read it");
            }},
    LagRule{"cost-filter", dearest_is<Stage::Filter>,
            [](const LagFacts& f) {
                return cost(f, filters_gaze(f) ? "in the gaze filter and while the foveae are "
                                                 "computed"
                                               : "while the foveae are computed");
            }},
    LagRule{"cost-submit", dearest_is<Stage::Submit>,
            [](const LagFacts& f) {
                return cost(f, "on the CPU, between the read gaze and the last pass handed over");
            }},
    LagRule{"cost-gpu", dearest_is<Stage::Gpu>,
            [](const LagFacts& f) { return cost(f, "on the GPU" + dearest_pass(f)); }},
    LagRule{"cost-wait", dearest_is<Stage::Wait>,
            [](const LagFacts& f) {
                return cost(f, "while the finished picture waits for the display");
            }},
    LagRule{"cost-row", dearest_is<Stage::Row>,
            [](const LagFacts& f) {
                return cost(f, "until the display lights the row that is looked at");
            }},
    LagRule{"cost-switching", dearest_is<Stage::Switching>,
            [](const LagFacts& f) { return cost(f, "until the display's pixels have switched"); }},
    LagRule{"cost-unaccounted", dearest_is_unaccounted,
            [](const LagFacts& f) { return cost(f, "where nobody stamps anything"); }},
};

// Budget.

/// What is held against the budget: the p95, or the greatest where that is withheld.
double late_ms(const LagFacts& facts) {
    return age_of(facts).p95_ms.value_or(*age_of(facts).max_ms);
}

bool budget_applies(const LagFacts& facts) {
    return facts.budget != nullptr && facts.budget->total_ns && has_age(facts);
}

double budget_ms(const LagFacts& facts) {
    return static_cast<double>(*facts.budget->total_ns) / time::kNsPerMs;
}

/// ", of which this stage takes more than its 10.0 ms"; empty where the stage has no limit or keeps
/// it.
std::string stage_over(const LagFacts& facts) {
    const DearestStage dearest = *dearest_stage(*facts.report);
    if (!dearest.stage) {
        return "";
    }
    const auto stage = static_cast<std::size_t>(*dearest.stage);
    const auto limit_ns = facts.budget->stages_ns[stage];
    const DurationRow& row = facts.report->stages[stage];
    const double limit_ms = static_cast<double>(limit_ns.value_or(0)) / time::kNsPerMs;
    const double stage_ms = row.p95_ms.value_or(*row.max_ms);
    return limit_ns && stage_ms > limit_ms
               ? fmt::format(" It allows that stage {}, which takes {}.",
                             milliseconds_text(limit_ms), milliseconds_text(stage_ms))
               : "";
}

constexpr std::array kBudget{
    LagRule{"budget-not-judged",
            [](const LagFacts& f) {
                return budget_applies(f) && f.report->verdict == Verdict::NotRealTime;
            },
            [](const LagFacts& f) {
                return fmt::format("Against the budget {} ({}) it is not judged.", f.budget->name,
                                   milliseconds_text(budget_ms(f)));
            }},
    LagRule{"budget-broken",
            [](const LagFacts& f) { return budget_applies(f) && late_ms(f) > budget_ms(f); },
            [](const LagFacts& f) {
                return fmt::format(
                    "The budget {} allows {}, which {} by {}{}.{}", f.budget->name,
                    milliseconds_text(budget_ms(f)),
                    age_of(f).p95_ms ? "5 % of the frames exceed" : "the latest frame exceeds",
                    milliseconds_text(late_ms(f) - budget_ms(f)),
                    age_of(f).p95_ms ? " or more" : "", stage_over(f));
            }},
    LagRule{"budget-kept", budget_applies,
            [](const LagFacts& f) {
                return fmt::format("The budget {} allows {}, which {} keep with {} to spare.{}",
                                   f.budget->name, milliseconds_text(budget_ms(f)),
                                   age_of(f).p95_ms ? "95 % of the frames" : "all frames",
                                   milliseconds_text(budget_ms(f) - late_ms(f)), stage_over(f));
            }},
};

// Remedy.

/// Of the frames, %; more are a matter of the GPU's work, not of when frames begin.
constexpr double kManyMissed_percent = 1.0;

/// The tracker's samples follow on each other so quickly, ms; 0: unknown.
double sample_interval_ms(const LagFacts& facts) {
    return facts.smoothing.rate_hz > 0.0 ? 1e3 / facts.smoothing.rate_hz : 0.0;
}

/// A sample waits longer than its successor takes to come.
bool waits_beyond_next(const LagFacts& facts) {
    const double interval_ms = sample_interval_ms(facts);
    return interval_ms > 0.0 && row_of(facts, Stage::Queue).mean_ms.value_or(0.0) > interval_ms;
}

constexpr std::array kRemedy{
    LagRule{"try-being-worn",
            [](const LagFacts& f) {
                return f.report->frames.rendered == 0 && f.report->frames.total > 0;
            },
            [](const LagFacts&) {
                return std::string(
                    "The runtime asked for no picture: put the headset on, and "
                    "close what lies over the program.");
            }},
    LagRule{
        "try-its-log",
        [](const LagFacts& f) { return f.report->frames.rendered == 0 && f.log_missing; },
        [](const LagFacts&) {
            return std::string(
                "The recording's log (-wal) is not beside it: copy it there, and report again.");
        }},
    LagRule{"try-more-frames", [](const LagFacts& f) { return f.report->frames.rendered == 0; },
            [](const LagFacts&) {
                return std::string("Run longer, or see why the run ended before its first frame.");
            }},
    LagRule{"try-devices",
            [](const LagFacts& f) {
                return f.report->frames.with_gaze() == 0 && f.report->gaze.received == 0;
            },
            [](const LagFacts&) {
                return std::string(
                    "No sample came at all: gazeloop devices says why a tracker gives none; where "
                    "gaze comes as datagrams (OSC), see whether their sender names this machine "
                    "and port.");
            }},
    LagRule{"try-younger-samples",
            [](const LagFacts& f) {
                return f.report->frames.with_gaze() == 0 &&
                       f.use.lost_by_reason[static_cast<std::size_t>(gaze::LossReason::Stale)] > 0;
            },
            [](const LagFacts& f) {
                return fmt::format(
                    "Its samples were too old when they were read: more than "
                    "gaze.stale_ms{}.",
                    now(f, "gaze.stale_ms"));
            }},
    LagRule{
        "try-placing-gaze",
        [](const LagFacts& f) { return f.report->frames.with_gaze() == 0 && !f.unplaced.empty(); },
        [](const LagFacts& f) {
            return fmt::format("Set what it does not state: {}.", f.unplaced);
        }},
    LagRule{"try-calibrating", [](const LagFacts& f) { return f.report->frames.with_gaze() == 0; },
            [](const LagFacts& f) {
                return fmt::format(
                    "The tracker vouches for neither eye in {} of its {} samples: "
                    "calibrate it anew and seat the headset, or lower "
                    "gaze.minimum_confidence{}.",
                    f.report->gaze.invalid, f.report->gaze.received,
                    now(f, "gaze.minimum_confidence"));
            }},
    LagRule{"try-finding-the-eye", often_lost, loss_remedy},
    LagRule{"try-nothing", [](const LagFacts& f) { return !has_age(f); },
            [](const LagFacts&) {
                return std::string("Where the time goes can be told once that is mended.");
            }},
    LagRule{"try-a-gpu",
            [](const LagFacts& f) {
                return f.report->verdict == Verdict::NotRealTime &&
                       !f.device_value("processor").empty();
            },
            [](const LagFacts& f) {
                return fmt::format(
                    "No GPU drew these pictures but the processor ({}): use a machine with a GPU"
                    "{}, or try the rest with a small picture: "
                    "{}.",
                    f.device_value("vulkan device"),
                    is_of_another_program(f) ? "" : " (gazeloop doctor lists what it finds)",
                    is_of_another_program(f) ? less_gpu_work(f)
                                             : "a lower render.scale" + now(f, "render.scale"));
            }},
    LagRule{"try-keeping-up",
            [](const LagFacts& f) { return f.report->verdict == Verdict::NotRealTime; },
            [](const LagFacts& f) { return "Try first to keep up: " + less_gpu_work(f) + "."; }},
    LagRule{"try-wall-clock",
            [](const LagFacts& f) { return f.report->verdict == Verdict::VirtualTime; },
            [](const LagFacts&) {
                return std::string("To measure it, run in real time (--clock wall).");
            }},
    LagRule{"try-sim-delay",
            [](const LagFacts& f) {
                return dearest_is<Stage::Tracker>(f) && f.origin == GazeOrigin::Simulated;
            },
            [](const LagFacts& f) {
                return fmt::format("That tracker is simulated: sim.delay_ms{} sets it.",
                                   now(f, "sim.delay_ms"));
            }},
    LagRule{"try-tracker-profile",
            [](const LagFacts& f) {
                return dearest_is<Stage::Tracker>(f) && f.origin == GazeOrigin::Trace;
            },
            [](const LagFacts& f) {
                return fmt::format(
                    "That is the delay of the tracker profile{}: {} names "
                    "the one that recorded the trace.",
                    now(f, "profile.tracker"),
                    is_of_another_program(f) ? "profile.tracker" : "--tracker");
            }},
    LagRule{"try-another-tracker", dearest_is<Stage::Tracker>,
            [](const LagFacts&) {
                return std::string(
                    "Nothing in software helps there: try a faster mode or a higher "
                    "rate of the tracker, if it has one.");
            }},
    LagRule{"try-usb-port", dearest_is<Stage::Delivery>,
            [](const LagFacts&) {
                return std::string("Try to give the tracker a USB port of its own, without a hub.");
            }},
    LagRule{"try-steady-samples",
            [](const LagFacts& f) { return dearest_is<Stage::Queue>(f) && waits_beyond_next(f); },
            [](const LagFacts& f) {
                return fmt::format(
                    "A newer sample should come every {}: look why the tracker's "
                    "samples stop or come in bursts (gazeloop devices).",
                    milliseconds_text(sample_interval_ms(f)));
            }},
    LagRule{"try-higher-rate", dearest_is<Stage::Queue>,
            [](const LagFacts& f) {
                return fmt::format(
                    "Try a higher rate of the tracker{}{}.",
                    f.smoothing.rate_hz > 0.0 ? fmt::format(" (now {:.0f} Hz)", f.smoothing.rate_hz)
                                              : "",
                    is_of_another_program(f) || f.setting("render.wait_before_latch") == "true"
                        ? ""
                        : ", or render.wait_before_latch=true, which reads the gaze later");
            }},
    LagRule{"try-no-filter",
            [](const LagFacts& f) { return dearest_is<Stage::Filter>(f) && filters_gaze(f); },
            [](const LagFacts& f) {
                return fmt::format("Try gaze.filter=none (now {}), or a shorter memory of it.",
                                   f.setting("gaze.filter"));
            }},
    LagRule{"try-more-cpu",
            [](const LagFacts& f) {
                return dearest_is<Stage::Filter>(f) || dearest_is<Stage::Submit>(f);
            },
            [](const LagFacts& f) {
                return is_of_another_program(f)
                           ? fmt::format("Try to leave {} more of the CPU: close other programs.",
                                         f.device_value("application"))
                           : std::string(
                                 "Try to leave the loop more of the CPU: close other programs, or "
                                 "raise its priority (gazeloop doctor says how).");
            }},
    LagRule{"try-less-gpu-work", dearest_is<Stage::Gpu>,
            [](const LagFacts& f) { return "Try " + less_gpu_work(f) + "."; }},
    LagRule{"try-missing-less",
            [](const LagFacts& f) {
                return dearest_is<Stage::Wait>(f) &&
                       f.report->missed_percent().value_or(0.0) > kManyMissed_percent;
            },
            [](const LagFacts& f) {
                return fmt::format(
                    "{:.1f} % of the frames miss their time and wait for the next "
                    "period of {}: try {}.",
                    *f.report->missed_percent(), milliseconds_text(period_ms(f)), less_gpu_work(f));
            }},
    LagRule{"try-shorter-period", dearest_is<Stage::Wait>,
            [](const LagFacts& f) {
                return fmt::format(
                    "The picture is ready in time, and the runtime decides how long "
                    "before its display a frame begins: try a display mode with a "
                    "shorter period{}.",
                    f.report->config.period_ns > 0
                        ? fmt::format(" (now {})", milliseconds_text(period_ms(f)))
                        : "");
            }},
    LagRule{"try-another-display",
            [](const LagFacts& f) {
                return dearest_is<Stage::Row>(f) || dearest_is<Stage::Switching>(f);
            },
            [](const LagFacts&) {
                return std::string(
                    "Nothing in software helps there: try a faster mode of the "
                    "display, if it has one.");
            }},
    LagRule{"try-timing-the-gpu",
            [](const LagFacts& f) {
                return dearest_is_unaccounted(f) && row_of(f, Stage::Gpu).count == 0;
            },
            [](const LagFacts& f) {
                return is_of_another_program(f)
                           ? fmt::format(
                                 "It lies between the frame that {} handed over and the display, "
                                 "where a layer sees nothing: its GPU, the compositor and the wait "
                                 "for the display. Try {}.",
                                 f.device_value("application"), less_gpu_work(f))
                           : std::string(
                                 "It lies between the last submit and the display, because the "
                                 "GPU's times are unknown: gazeloop doctor says what its driver "
                                 "lacks.");
            }},
    LagRule{"try-a-free-gpu", dearest_is_unaccounted,
            [](const LagFacts& f) {
                return fmt::format(
                    "It is mostly the driver's queue, before the GPU begins: close "
                    "what else uses the GPU{}.",
                    is_of_another_program(f)
                        ? ""
                        : ", or try render.frames_in_flight=1" + now(f, "render.frames_in_flight"));
            }},
};

// Unknown.

/// "unknown in 3 of 200 frames".
std::string unknown_in(std::uint64_t frames, std::uint64_t of) {
    return frames == of ? fmt::format("unknown in all {} frames", of)
                        : fmt::format("unknown in {} of {} frames", frames, of);
}

std::uint64_t without(const LagFacts& facts, const DurationRow& row) {
    const std::uint64_t with_gaze = facts.report->frames.with_gaze();
    return with_gaze - std::min(row.count, with_gaze);
}

constexpr std::array kUnknown{
    LagRule{"unknown-sample-time",
            [](const LagFacts& f) { return without(f, f.report->gaze_age_at_latch) > 0; },
            [](const LagFacts& f) {
                return fmt::format(
                    "When the eye was seen is {}, because the source gives no time "
                    "with those samples that means anything: {}.",
                    unknown_in(without(f, f.report->gaze_age_at_latch),
                               f.report->frames.with_gaze()),
                    f.origin == GazeOrigin::Runtime
                        ? "a runtime that fills in XrEyeGazeSampleTimeEXT tells it"
                        : "gazeloop devices says what its timestamps are worth");
            }},
    LagRule{"unknown-display-time",
            [](const LagFacts& f) { return f.report->frames.display_unknown > 0; },
            [](const LagFacts& f) {
                return fmt::format(
                    "When the picture was shown is {}: the runtime announced no "
                    "time for them that can be.",
                    unknown_in(f.report->frames.display_unknown, f.report->frames.rendered));
            }},
    LagRule{
        "unknown-gpu-time", [](const LagFacts& f) { return without(f, row_of(f, Stage::Gpu)) > 0; },
        [](const LagFacts& f) {
            return fmt::format(
                "When the GPU was done is {}, so that it is not known whether "
                "they were shown in time: {}.",
                unknown_in(without(f, row_of(f, Stage::Gpu)), f.report->frames.with_gaze()),
                is_of_another_program(f) ? "the layer does not see it, a runtime's own metrics may "
                                           "(--runtime-metrics)"
                                         : "a driver with VK_EXT_calibrated_timestamps tells it");
        }},
    LagRule{"unknown-display",
            [](const LagFacts& f) { return has_age(f) && !f.report->config.switching_ns; },
            [](const LagFacts& f) {
                return fmt::format(
                    "How long the display's pixels take to switch is unknown and "
                    "comes on top{}.",
                    is_of_another_program(f)
                        ? ""
                        : ": a display profile that states it (--display) tells it");
            }},
};

}  // namespace

std::span<const LagRule> lag_rules(LagSubject subject) {
    switch (subject) {
        case LagSubject::Standing:
            return kStanding;
        case LagSubject::Loss:
            return kLoss;
        case LagSubject::Cost:
            return kCost;
        case LagSubject::Budget:
            return kBudget;
        case LagSubject::Remedy:
            return kRemedy;
        case LagSubject::Unknown:
            return kUnknown;
    }
    return {};
}

}  // namespace gazeloop::report

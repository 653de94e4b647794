#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tests/bench/bench.h"
#include "tests/support/misses/sharp_region.h"
#include "tests/support/misses/simulated_people.h"
#include "tests/support/misses/widening_trial.h"

namespace gazeloop::bench {
namespace {

constexpr const char* kBench = "misses";
constexpr double kAllowed_percent = 1.0;
constexpr double kFewer_percent = 30.0;

using tests::Counted;
using tests::WideningRule;

struct Display {
    const char* name;
    std::uint32_t side_px;
    double across_deg;
};
/// As dense as the one of the name in its middle, square.
constexpr std::array kDisplays{Display{"2160 px, 100 deg", 2160, 100.0},
                               Display{"3800 px, 110 deg", 3800, 110.0},
                               Display{"60 px per deg", 8192, 100.0}};

struct Rule {
    const char* name;
    WideningRule rule;
};
constexpr std::array kRules{Rule{"by age", WideningRule::ByAge},
                            Rule{"by events", WideningRule::ByEvents},
                            Rule{"suppressed", WideningRule::Suppressed}};

}  // namespace

std::vector<Figure> misses(const Options& options) {
    constexpr std::uint64_t kPersons = 32;
    std::vector<Figure> figures;
    for (const bool chosen_on : {true, false}) {
        const std::uint64_t first = chosen_on ? tests::kFirstChosenOn : tests::kFirstOther;
        const auto trial = [&](WideningRule rule) {
            return tests::widening_trial(rule, first, kPersons, tests::kGenericTracker);
        };
        const std::array plain{trial(WideningRule::Held), trial(WideningRule::Predicted)};
        std::vector<std::vector<tests::ShownGaze>> ruled;
        ruled.reserve(std::size(kRules));
        for (const Rule& rule : kRules) {
            ruled.push_back(trial(rule.rule));
        }
        for (const Display& display : kDisplays) {
            if (!options.wants(display.name)) {
                continue;
            }
            const tests::SharpRegion sharp(tests::square_view(display.side_px, display.across_deg));
            const auto add = [&](const std::string& metric, double value, const char* unit,
                                 const char* better, std::optional<double> target) {
                figures.push_back(
                    {kBench, display.name,
                     fmt::format("{}: {}", chosen_on ? "chosen on" : "others", metric), value, unit,
                     better, std::nullopt, target});
            };
            // Of holding and predicting, whichever needs the fewer samples.
            const double constant =
                std::min(sharp.samples(tests::constant_widening_deg(plain[0], sharp, Counted::Seen,
                                                                    kAllowed_percent)),
                         sharp.samples(tests::constant_widening_deg(plain[1], sharp, Counted::Seen,
                                                                    kAllowed_percent)));
            add("held, not widened: misses", misses_percent(plain[0], sharp, Counted::Seen), "%",
                "lower", {});
            add("not widened: samples", 1e-3 * sharp.samples(0.0), "k", "lower", {});
            add("constant widening for 1 %: samples", 1e-3 * constant, "k", "lower", {});
            for (std::size_t i = 0; i < kRules.size(); ++i) {
                const auto& shown = ruled[i];
                const bool judged = kRules[i].rule == WideningRule::ByEvents && !chosen_on;
                const auto of = [&](const char* what) {
                    return fmt::format("{}: {}", kRules[i].name, what);
                };
                add(of("misses"), misses_percent(shown, sharp, Counted::Seen), "%", "lower",
                    judged ? std::optional(kAllowed_percent) : std::nullopt);
                add(of("misses, in flight too"),
                    misses_percent(shown, sharp, Counted::SeenOrInFlight), "%", "lower", {});
                const double samples = mean_samples(shown, sharp);
                add(of("samples"), 1e-3 * samples, "k", "lower", {});
                add(of("fewer than constant"), 100.0 * (1.0 - samples / constant), "%", "higher",
                    judged ? std::optional(kFewer_percent) : std::nullopt);
            }
        }
    }
    return figures;
}

}  // namespace gazeloop::bench

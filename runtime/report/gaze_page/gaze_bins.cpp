#include "runtime/report/gaze_page/gaze_bins.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>
#include <optional>

#include "runtime/gaze/direction.h"
#include "runtime/gaze/usable_direction.h"
#include "runtime/report/page/number_stream.h"

namespace gazeloop::report::page {
namespace {

double azimuth_deg(const glm::dvec3& direction) {
    return glm::degrees(std::atan2(direction.x, -direction.z));
}

double elevation_deg(const glm::dvec3& direction) {
    return glm::degrees(std::atan2(direction.y, std::hypot(direction.x, direction.z)));
}

/// Calls `look` with each sample whose time is known and later than the last one's.
void each_in_order(const gaze::SampleRange& samples, const auto& look) {
    std::optional<std::int64_t> last_ns;
    for (const gaze::GazeSample& sample : samples) {
        if (sample.sampled.known() && (!last_ns || sample.sampled.ns > *last_ns)) {
            look(sample);
            last_ns = sample.sampled.ns;
        }
    }
}

/// Samples in order.
struct Ordered {
    std::size_t count = 0;
    std::int64_t first_ns = 0;
    std::int64_t last_ns = 0;

    explicit Ordered(const gaze::SampleRange& samples) {
        each_in_order(samples, [this](const gaze::GazeSample& sample) {
            last_ns = sample.sampled.ns;
            first_ns = count++ == 0 ? last_ns : first_ns;
        });
    }
};

double seconds(std::int64_t ns) { return static_cast<double>(ns) * 1e-9; }

std::optional<glm::dvec3> middle_of(const gaze::GazeSample& sample) {
    glm::dvec3 sum{0.0};
    for (const gaze::EyeRay& ray : sample.eyes) {
        sum += gaze::usable_direction(ray, 0.0).value_or(glm::dvec3{0.0});
    }
    return gaze::unit(sum);
}

void merge(GazeBin& into, const GazeBin& bin) {
    into.samples += bin.samples;
    for (std::size_t event = 0; event < into.by_event.size(); ++event) {
        into.by_event[event] += bin.by_event[event];
    }
    for (std::size_t series = 0; series < into.angles.size(); ++series) {
        into.angles[series].add(bin.angles[series]);
    }
}

}  // namespace

void AngleRange::add(double angle_deg) {
    least_deg = std::min(least_deg, angle_deg);
    greatest_deg = std::max(greatest_deg, angle_deg);
    sum_deg += angle_deg;
    ++count;
}

void AngleRange::add(const AngleRange& more) {
    least_deg = std::min(least_deg, more.least_deg);
    greatest_deg = std::max(greatest_deg, more.greatest_deg);
    sum_deg += more.sum_deg;
    count += more.count;
}

GazeBins gaze_bins(const gaze::SampleRange& samples, std::span<const gaze::RecordedEvent> events) {
    const Ordered ordered(samples);
    GazeBins found{.series = {"left_azimuth", "right_azimuth", "left_elevation", "right_elevation"},
                   .bins = {}};
    if (ordered.count == 0) {
        return found;
    }
    const std::int64_t first_ns = ordered.first_ns;
    found.end_s = seconds(ordered.last_ns - first_ns);
    const std::size_t each = (ordered.count + kMostBins - 1) / kMostBins;
    auto event = events.begin();
    std::size_t i = 0;
    each_in_order(samples, [&](const gaze::GazeSample& sample) {
        if (i % each == 0) {
            found.bins.push_back(
                {.begin_s = seconds(sample.sampled.ns - first_ns), .first_sample = i});
        }
        ++i;
        GazeBin& bin = found.bins.back();
        ++bin.samples;
        while (event != events.end() && event + 1 != events.end() &&
               sample.sampled.ns >= (event + 1)->begin_ns) {
            ++event;
        }
        if (event != events.end()) {
            ++bin.by_event[static_cast<std::size_t>(event->event) - 1];
        }
        for (const gaze::Eye eye : gaze::kEyes) {
            if (const auto direction = gaze::usable_direction(sample.eyes[gaze::index(eye)], 0.0)) {
                bin.angles[gaze::index(eye)].add(azimuth_deg(*direction));
                bin.angles[gaze::kEyeCount + gaze::index(eye)].add(elevation_deg(*direction));
            }
        }
    });
    return found;
}

GazeBins compared_bins(const gaze::SampleRange& one, const gaze::SampleRange& other,
                       double lag_ms) {
    const std::array samples_of{one, other};
    const std::array both{Ordered(one), Ordered(other)};
    GazeBins found{.series = {"one_azimuth", "other_azimuth", "one_elevation", "other_elevation"},
                   .bins = {}};
    if (both[0].count < 2 || both[1].count < 2) {
        return found;
    }
    const auto length_s = [](const Ordered& ordered) {
        return seconds(ordered.last_ns - ordered.first_ns);
    };
    found.end_s = length_s(both[0]);
    double coarsest_s = 0.0;
    for (const Ordered& ordered : both) {
        coarsest_s =
            std::max(coarsest_s, length_s(ordered) / static_cast<double>(ordered.count - 1));
    }
    const double width_s =
        std::max(2.0 * coarsest_s, found.end_s / static_cast<double>(kMostBins - 1));
    const auto bins = static_cast<std::size_t>(found.end_s / width_s) + 1;
    for (std::size_t bin = 0; bin < bins; ++bin) {
        found.bins.push_back({.begin_s = static_cast<double>(bin) * width_s});
    }
    for (std::size_t which = 0; which < both.size(); ++which) {
        const double earlier_s = which == 0 ? 0.0 : 1e-3 * lag_ms;
        each_in_order(samples_of[which], [&](const gaze::GazeSample& sample) {
            const double at_s = seconds(sample.sampled.ns - both[which].first_ns) - earlier_s;
            const auto direction = middle_of(sample);
            if (at_s < 0.0 || at_s > found.end_s || !direction) {
                return;
            }
            GazeBin& bin = found.bins[std::min(static_cast<std::size_t>(at_s / width_s), bins - 1)];
            bin.samples += which == 0 ? 1 : 0;
            bin.angles[which].add(azimuth_deg(*direction));
            bin.angles[2 + which].add(elevation_deg(*direction));
        });
    }
    return found;
}

std::vector<GazeBin> in_parts(const GazeBins& bins, std::size_t most) {
    std::vector<GazeBin> parts;
    const std::size_t count = std::min(most, bins.bins.size());
    for (std::size_t part = 0; part < count; ++part) {
        const std::size_t first = bins.bins.size() * part / count;
        const std::size_t end = bins.bins.size() * (part + 1) / count;
        GazeBin& merged = parts.emplace_back(bins.bins[first]);
        for (std::size_t bin = first + 1; bin < end; ++bin) {
            merge(merged, bins.bins[bin]);
        }
    }
    return parts;
}

nlohmann::ordered_json stream_json(const GazeBins& bins) {
    constexpr double kTicksPerSecond = 1e5;
    constexpr double kTicksPerDegree = 1e3;
    NumberStream stream;
    const auto each = [&](const auto& number_of) {
        stream.begin_series();
        for (const GazeBin& bin : bins.bins) {
            stream.add(number_of(bin));
        }
    };
    each([](const GazeBin& bin) { return std::llround(bin.begin_s * kTicksPerSecond); });
    each([](const GazeBin& bin) { return static_cast<std::int64_t>(bin.first_sample); });
    each([](const GazeBin& bin) { return static_cast<std::int64_t>(bin.samples); });
    for (std::size_t event = 0; event < gaze::kEyeEventNames.size(); ++event) {
        each(
            [event](const GazeBin& bin) { return static_cast<std::int64_t>(bin.by_event[event]); });
    }
    const auto down = [](const AngleRange& range) {
        return static_cast<std::int64_t>(std::floor(range.least_deg * kTicksPerDegree));
    };
    const auto up = [](const AngleRange& range) {
        return static_cast<std::int64_t>(std::ceil(range.greatest_deg * kTicksPerDegree));
    };
    for (std::size_t series = 0; series < bins.series.size(); ++series) {
        const auto known = [series](const GazeBin& bin, const auto& number_of) {
            const AngleRange& range = bin.angles[series];
            return range.count > 0 ? std::optional<std::int64_t>(number_of(range)) : std::nullopt;
        };
        each([&](const GazeBin& bin) { return known(bin, down); });
        each([&](const GazeBin& bin) {
            return known(bin, [&](const AngleRange& range) {
                return range.count > 1 ? up(range) - down(range) : std::int64_t{0};
            });
        });
    }
    return {{"bins", bins.bins.size()},
            {"end", std::llround(bins.end_s * kTicksPerSecond)},
            {"series", bins.series},
            {"data", packed(stream.bytes())}};
}

}  // namespace gazeloop::report::page

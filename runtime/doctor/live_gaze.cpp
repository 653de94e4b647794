#include "runtime/doctor/live_gaze.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <glm/trigonometric.hpp>
#include <string>
#include <system_error>

#include "runtime/time/clock.h"

namespace gazeloop::doctor {
namespace {

std::string eye_text(const gaze::EyeRay& ray) {
    if (!ray.valid) {
        return "      -       -  ";
    }
    return fmt::format("{:+7.2f} {:+7.2f}  ",
                       glm::degrees(std::atan2(ray.direction.x, -ray.direction.z)),
                       glm::degrees(std::asin(std::clamp(ray.direction.y, -1.0, 1.0))));
}

std::string watched_text(const gaze::GazeSample& last, std::size_t samples) {
    const std::string age =
        last.sampled.known()
            ? fmt::format("{:.1f} +/- {:.1f} ms at its arrival",
                          static_cast<double>(last.arrived.ns - last.sampled.ns) * 1e-6,
                          static_cast<double>(last.uncertainty_ns.value_or(0)) * 1e-6)
            : std::string("unknown");
    return fmt::format("{}{}{:4}  {}", eye_text(last.eyes[0]), eye_text(last.eyes[1]), samples,
                       age);
}

}  // namespace

bool watch_gaze(const std::vector<drivers::GazeSource*>& sources, double seconds,
                const std::function<bool()>& interrupted) {
    constexpr std::int64_t kEvery_ns = 100'000'000;
    constexpr std::int64_t kSilent = 2;  // ticks; a slow tracker may miss one
    constexpr std::int64_t kSecond = 10;
    const bool terminal = isatty(STDOUT_FILENO) != 0;
    std::vector<gaze::GazeSample> samples;
    bool any = false;
    std::int64_t last_heard = 0;
    const std::int64_t begin_ns = time::monotonic_ns();
    fmt::print("degrees right, up: left eye, right eye; samples; age\n");
    for (std::int64_t i = 1; !interrupted(); ++i) {
        const std::int64_t now_ns = begin_ns + i * kEvery_ns;
        if (static_cast<double>(now_ns - begin_ns) * 1e-9 > seconds) {
            break;
        }
        time::sleep_until_ns(now_ns);
        samples.clear();
        for (drivers::GazeSource* const source : sources) {
            source->poll(now_ns, samples);
            for (const drivers::SourceEvent& event : source->take_events()) {
                fmt::print("{}{}\n", terminal ? "\r\x1b[K" : "", event.text);
            }
        }
        const std::int64_t silent = samples.empty() ? i - last_heard : 0;
        std::string line;
        if (!samples.empty()) {
            last_heard = i;
            const gaze::GazeSample& last = samples.back();
            any = any || last.eyes[0].valid || last.eyes[1].valid;
            line = watched_text(last, samples.size());
        } else if (terminal ? silent >= kSilent : silent % kSecond == 0) {
            line = fmt::format("{}{}   0  nothing for {} s", eye_text({}), eye_text({}),
                               silent / kSecond);
        }
        if (!line.empty()) {
            fmt::print("{}{}{}", terminal ? "\r\x1b[K" : "", line, terminal ? "" : "\n");
        }
        if (std::fflush(stdout) != 0) {  // nobody would see what comes; as fmt's printing does
            throw std::system_error(errno, std::generic_category(), "stdout");
        }
    }
    fmt::print("{}", terminal ? "\n" : "");
    return any;
}

}  // namespace gazeloop::doctor

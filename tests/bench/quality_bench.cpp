#include <chrono>
#include <ctime>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "runtime/error.h"
#include "runtime/quality/comparison.h"
#include "tests/bench/bench.h"

namespace gazeloop::bench {
namespace {

constexpr const char* kBench = "quality";
constexpr unsigned kThreads = 2;
constexpr double kTargetMs = 1000.0;

struct Case {
    const char* name;
    std::uint32_t width;
    std::uint32_t height;
};
constexpr Case kCases[] = {
    {"1280x1440", 1280, 1440}, {"1920x1080", 1920, 1080}, {"2560x1440", 2560, 1440}};

render::LinearPicture noise(const Case& size, unsigned seed) {
    std::mt19937 random(seed);
    render::LinearPicture picture{size.width, size.height, {}};
    const auto draw = [&] { return static_cast<float>(random() >> 8U) * 0x1p-24F; };
    for (std::size_t at = 0; at < std::size_t{size.width} * size.height; ++at) {
        picture.pixels.emplace_back(draw(), draw(), draw());
    }
    return picture;
}

struct Ms {
    double wall;
    double processor;
};

Ms measure(const std::function<void()>& work) {
    const auto begin = std::chrono::steady_clock::now();
    const std::clock_t processor = std::clock();
    work();
    return {
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count(),
        1e3 * static_cast<double>(std::clock() - processor) / CLOCKS_PER_SEC};
}

}  // namespace

std::vector<Figure> quality(const Options& options) {
    constexpr double kHalf_rad = 50.0 * std::numbers::pi / 180.0;
    std::vector<Figure> figures;
    for (const Case& size : kCases) {
        if (!options.wants(size.name)) {
            continue;
        }
        const render::LinearPicture reference = noise(size, 1);
        const render::LinearPicture test = noise(size, 2);
        for (std::size_t metric = 0; metric <= quality::kMetrics; ++metric) {
            // Once more, the first one on a sequence, each frame with a gaze of its own.
            const bool sequence = metric == quality::kMetrics;
            quality::ComparisonQuestion question{
                .view = {.fov = {-kHalf_rad, kHalf_rad, kHalf_rad, -kHalf_rad},
                         .width_px = size.width,
                         .height_px = size.height},
                .metrics = {},
                .contrast = {.light = {}, .threads = kThreads},
                .frame_seconds = sequence ? std::optional(1.0 / 90.0) : std::nullopt};
            question.metrics[sequence ? 0 : metric] = true;
            auto comparison = value_or_throw(quality::Comparison::create(question));
            std::vector<double> wall_ms;
            std::vector<double> processor_ms;
            for (unsigned round = 0; round <= options.rounds; ++round) {
                const Ms ms = measure([&] {
                    (void)value_or_throw(
                        comparison.compare(reference, test, {0.01 * round, 0.0, -1.0}));
                });
                if (round > 0) {  // the first one takes its memory
                    wall_ms.push_back(ms.wall);
                    processor_ms.push_back(ms.processor);
                }
            }
            const std::string name = std::string(quality::kMetricNames[sequence ? 0 : metric]) +
                                     (sequence ? ", sequence" : "");
            figures.push_back(
                {kBench, size.name, name, median(wall_ms), "ms", "lower", std::nullopt, kTargetMs});
            figures.push_back({kBench, size.name, name + ", processor", median(processor_ms), "ms",
                               "lower", std::nullopt, kThreads * kTargetMs});
        }
    }
    return figures;
}

}  // namespace gazeloop::bench

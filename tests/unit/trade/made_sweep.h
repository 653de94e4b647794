#pragma once

#include <string>
#include <vector>

#include "runtime/trade/sweep_record.h"

namespace gazeloop::tests {

/// A sweep of a display of 10x10 px: full resolution (200 cells, 8 ms, contrast 1) and kfr with
/// sigma 2 (50 cells, 2 ms, contrast 2) and 4 (12.5 cells, 1 ms, contrast 4), in `cases` cases of
/// `frames` frames and `rounds` rounds.
inline trade::SweepRecord made_sweep(std::size_t cases = 1, std::size_t frames = 2,
                                     unsigned rounds = 2) {
    trade::SweepRecord record{.subject = {.program = "0.1",
                                          .device = "a device",
                                          .display = "a display",
                                          .eye = "left",
                                          .width_px = 10,
                                          .height_px = 10,
                                          .frames = frames,
                                          .frame_seconds = 0.01,
                                          .samples = 4,
                                          .reference_samples = 16,
                                          .rounds = rounds,
                                          .peak_cd_m2 = 100.0,
                                          .black_cd_m2 = 0.1,
                                          .metrics = {"contrast"},
                                          .settings = {{"render.spp", "4"}}},
                              .cases = {},
                              .points = {{.method = "full"},
                                         {.method = "kfr", .settings = {{"kfr.sigma", "2"}}},
                                         {.method = "kfr", .settings = {{"kfr.sigma", "4"}}}}};
    constexpr std::array kCells{200.0, 50.0, 12.5};
    constexpr std::array kMs{8.0, 2.0, 1.0};
    constexpr std::array kContrast{1.0, 2.0, 4.0};
    for (std::size_t at = 0; at < cases; ++at) {
        record.cases.push_back(
            {.scene = "scene" + std::to_string(at), .gaze = "0,0", .fewest_cells = 5.0});
        for (std::size_t point = 0; point < record.points.size(); ++point) {
            record.judged.push_back({.of_case = at,
                                     .point = point,
                                     .cells = kCells[point],
                                     .passes = {"one", "two"},
                                     .figures = {{.key = "contrast",
                                                  .meaning = "thresholds",
                                                  .mean = kContrast[point],
                                                  .worst = kContrast[point] + 1.0,
                                                  .worst_frame = 1}}});
        }
        for (unsigned round = 0; round < rounds; ++round) {
            for (std::size_t frame = 0; frame < frames; ++frame) {
                trade::TimedTurn turn{.of_case = at, .round = round, .frame = frame};
                for (std::size_t point = 0; point < record.points.size(); ++point) {
                    turn.times.push_back(
                        {.point = point, .pass_ms = {0.25 * kMs[point], 0.75 * kMs[point]}});
                }
                record.turns.push_back(turn);
            }
        }
    }
    return record;
}

}  // namespace gazeloop::tests

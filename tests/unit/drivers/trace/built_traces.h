#pragma once

#include <cstdint>
#include <utility>

#include "drivers/trace/built_trace.h"
#include "runtime/error.h"
#include "runtime/gaze/gaze_trace.h"

namespace gazeloop::drivers {

/// All of a built trace.
inline gaze::GazeTrace all_of(const BuiltTrace& built) {
    return gaze::in_memory({.file = built.file,
                            .format = built.format,
                            .device = built.device,
                            .samples = built.samples,
                            .report = built.report});
}

inline Expected<gaze::GazeTrace> all_of(const Expected<BuiltTrace>& built) {
    if (!built) {
        return std::unexpected(built.error());
    }
    return all_of(*built);
}

/// As if the trace's samples were rows of a file, from line 2 on.
inline BuiltTrace built_of(const gaze::GazeTrace& trace) {
    const auto rows = std::make_shared<memory::Spool<KeptRow>>();
    RowSamples::Judged judged;
    BuiltTrace built{.file = trace.file,
                     .format = trace.format,
                     .device = trace.device,
                     .samples = nullptr,
                     .lines = {},
                     .report = trace.report};
    for (const gaze::GazeSample& sample : trace.samples) {
        TraceRow row;
        row.eyes = sample.eyes;
        row.parallax_rad = sample.parallax_rad;
        row.head = sample.head;
        judged.rows.push_back(rows->size());
        judged.numbers.push_back(sample.sequence);
        judged.device_ns.push_back(sample.device_ns);
        judged.time_ns.push_back(sample.sampled.ns);
        judged.delay_ns.emplace_back();
        judged.step_ns.push_back(0);
        built.lines.push_back(rows->size() + 2);
        rows->add(KeptRow(row));
    }
    built.samples = std::make_shared<RowSamples>(rows, std::move(judged));
    return built;
}

}  // namespace gazeloop::drivers

#include "runtime/gaze/gaze_trace.h"

#include <utility>

namespace gazeloop::gaze {

GazeTrace in_memory(GazeRecording recording) {
    GazeTrace trace{.file = std::move(recording.file),
                    .format = std::move(recording.format),
                    .device = std::move(recording.device),
                    .samples = recording.samples->take(),
                    .report = std::move(recording.report)};
    return trace;
}

}  // namespace gazeloop::gaze

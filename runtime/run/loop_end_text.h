#pragma once

#include <string_view>

#include "runtime/frame_loop.h"

namespace gazeloop::run {

/// Why the loop ended, for people.
[[nodiscard]] constexpr std::string_view end_text(LoopEnd end) {
    switch (end) {
        case LoopEnd::Limit:
            return "limit reached";
        case LoopEnd::SourceEnd:
            return "gaze source ended";
        case LoopEnd::Interrupted:
            return "interrupted";
        case LoopEnd::Closed:
            return "the preview was closed";
        case LoopEnd::TargetEnd:
            return "ended by the runtime";
    }
    return "";
}

}  // namespace gazeloop::run

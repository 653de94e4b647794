#pragma once

#include <algorithm>
#include <array>
#include <string_view>

#include "runtime/report/perfetto/trace_writer.h"
#include "runtime/time/stamp.h"

namespace gazeloop::report::perfetto {

/// How a stamp was obtained, as an annotation's value.
class KindTexts {
  public:
    explicit KindTexts(TraceWriter& writer) {
        std::ranges::transform(time::kStampKindNames, texts_.begin(),
                               [&writer](std::string_view name) { return writer.text(name); });
    }
    [[nodiscard]] TextId of(time::StampKind kind) const {
        return texts_[static_cast<std::size_t>(kind)];
    }

  private:
    std::array<TextId, time::kStampKindCount> texts_{};
};

}  // namespace gazeloop::report::perfetto

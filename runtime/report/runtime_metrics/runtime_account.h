#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "runtime/error.h"
#include "runtime/frame/frame_observer.h"
#include "runtime/report/runtime_metrics/runtime_metrics_join.h"
#include "runtime/report/runtime_metrics/wivrn_stages.h"

namespace gazeloop::report {

/// Files that a runtime wrote of the run that a session is of; empty: none.
struct RuntimeFiles {
    std::string metrics{};  ///< Monado's, XRT_METRICS_FILE
    std::string csv{};      ///< WiVRn's, WIVRN_DUMP_TIMINGS
};

/// What a session's report takes from such files.
class RuntimeAccount {
  public:
    /// `noted_metrics`: what XRT_METRICS_FILE was in the run, by its session; used where none is
    /// given, and no error if it cannot be. Errors (BadInput): those of the readers.
    [[nodiscard]] static Expected<RuntimeAccount> open(const RuntimeFiles& files,
                                                       const std::string& noted_metrics);

    /// Who is to be told of the session, so that `observers` see its frames as joined. Both must
    /// outlive the telling. To be called once.
    [[nodiscard]] std::span<frame::FrameObserver* const> joined(
        std::span<frame::FrameObserver* const> observers);

    /// For the summary, lines of at most 100 columns; empty where there is nothing to say.
    [[nodiscard]] std::string text() const;
    /// Adds "runtime_metrics" and "runtime_csv" (null: none). The first one has only "error" where
    /// the file that the session notes was of no use.
    void add_to(nlohmann::ordered_json& summary) const;

  private:
    std::unique_ptr<MonadoMetricsReader> metrics_;  ///< until joined()
    std::unique_ptr<RuntimeMetricsJoin> join_;
    std::unique_ptr<WivrnStages> wivrn_;
    std::string noted_problem_;
    std::vector<frame::FrameObserver*> told_;
};

}  // namespace gazeloop::report

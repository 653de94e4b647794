#pragma once

#include <string>
#include <string_view>

#include "runtime/render/frame_renderer.h"

namespace gazeloop::render {

/// The passes and grids of several renderers that take turns in one run, as one list each: what one
/// of them counted and timed then has a place in the run's records.
class RunLists {
  public:
    /// `whose`, for messages: "the study's methods".
    explicit RunLists(std::string_view whose) : whose_(whose) {}

    /// Throws SetupError (Usage) if there are then more than a session has columns for.
    void add(const FrameRenderer& renderer);

    [[nodiscard]] const frame::PassList& passes() const { return passes_; }
    [[nodiscard]] const frame::GridList& grids() const { return grids_; }

    /// Precondition, here and below: all of the renderer's names are in the lists.
    [[nodiscard]] frame::SampleCounts in_run(const FrameRenderer& renderer,
                                             const frame::SampleCounts& counts) const;
    [[nodiscard]] frame::FrameGpuRecord in_run(const FrameRenderer& renderer,
                                               const frame::FrameGpuRecord& record) const;

  private:
    std::string whose_;
    frame::PassList passes_;
    frame::GridList grids_;
};

}  // namespace gazeloop::render

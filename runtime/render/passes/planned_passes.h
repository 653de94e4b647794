#pragma once

#include <memory>
#include <utility>

#include "runtime/render/passes/method_passes.h"

namespace gazeloop::render {

/// Passes that own their plan.
template <typename Plan>
class PlannedPasses : public MethodPasses {
  public:
    [[nodiscard]] const frame::PassList& passes() const final { return passes_; }
    [[nodiscard]] const Plan& plan() const final { return *plan_; }
    [[nodiscard]] bool fits(const gaze::StereoView& views) const final {
        return plan_->fits(views);
    }
    void prepare(const gaze::StereoView& views) final {
        value_or_throw(plan_->prepare(views));
        attach();
    }

  protected:
    PlannedPasses(frame::PassList passes, std::unique_ptr<Plan> plan)
        : passes_(std::move(passes)), plan_(std::move(plan)) {}

  private:
    /// Makes what the prepared plan needs on the GPU. Precondition: no frame is unfinished there.
    virtual void attach() {}

    frame::PassList passes_;
    std::unique_ptr<Plan> plan_;
};

}  // namespace gazeloop::render

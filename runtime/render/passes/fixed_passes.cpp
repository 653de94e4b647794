#include "runtime/render/passes/fixed_passes.h"

#include <utility>

#include "runtime/foveation/plans/fixed_plan.h"

namespace gazeloop::render {
namespace {

class FixedPasses final : public MethodPasses {
  public:
    explicit FixedPasses(std::unique_ptr<MethodPasses> held)
        : held_(std::move(held)), plan_(held_->plan()) {}

    [[nodiscard]] const frame::PassList& passes() const override { return held_->passes(); }
    [[nodiscard]] const foveation::MethodPlan& plan() const override { return plan_; }
    [[nodiscard]] bool fits(const gaze::StereoView& views) const override {
        return held_->fits(views);
    }
    void prepare(const gaze::StereoView& views) override { held_->prepare(views); }

    void record_before_gaze(vulkan::PassRecorder& recorder, const FrameRecording& frame) override {
        held_->record_before_gaze(recorder, frame);
    }
    void record_after_gaze(vulkan::PassRecorder& recorder, const FrameRecording& frame,
                           const gaze::PerEye<foveation::EyePlan>& plans) override {
        held_->record_after_gaze(recorder, frame, plans);
    }

    [[nodiscard]] bool is_foveated() const override { return held_->is_foveated(); }
    [[nodiscard]] double row_angle_rad(gaze::Eye eye) const override {
        return held_->row_angle_rad(eye);
    }
    [[nodiscard]] bool keeps_depth() const override { return held_->keeps_depth(); }
    void record_depth_copies(const vk::raii::CommandBuffer& commands, const FrameRecording& frame,
                             const gaze::PerEye<foveation::EyePlan>& plans,
                             const gaze::FrameFovea& fovea) override {
        held_->record_depth_copies(commands, frame, plans, fovea);
    }
    void collect_depth(std::size_t slot, gaze::SeenDepth& seen) const override {
        held_->collect_depth(slot, seen);
    }
    [[nodiscard]] std::vector<BufferPicture> buffers(
        gaze::Eye eye, const foveation::EyePlan& plan) const override {
        return held_->buffers(eye, plan);
    }

  private:
    std::unique_ptr<MethodPasses> held_;
    foveation::FixedPlan plan_;
};

}  // namespace

std::unique_ptr<MethodPasses> make_fixed_passes(std::unique_ptr<MethodPasses> held) {
    return std::make_unique<FixedPasses>(std::move(held));
}

}  // namespace gazeloop::render

#pragma once

#include <filesystem>
#include <vector>

#include "runtime/error.h"
#include "runtime/frame/frame_observer.h"
#include "runtime/render/frame_renderer.h"
#include "runtime/render/off_screen.h"

namespace gazeloop::render {

/// A picture between scene and result as it lies on the GPU, cells that the plan left out black.
Picture picture_of(const vulkan::Context& context, const BufferPicture& buffer);

struct SnapshotOptions {
    std::filesystem::path folder;  ///< created if missing
    bool mark_fovea = false;
    double difference_gain = 4.0;
};

/// Creates the folder if it is missing. Errors (BadInput).
Expected<void> make_snapshot_folder(const std::filesystem::path& folder);

/// Keeps a copy of the pictures of the frame that was rendered last, and writes them in the end.
/// They are the very pictures that were shown, because what a history made of them cannot be
/// rendered again.
class Snapshot final : public frame::FrameObserver {
  public:
    /// `renderer` must outlive this; it renders the frames that this observes.
    Snapshot(const vulkan::Context& context, const FrameRenderer& renderer);

    /// Submits a copy of the frame's pictures; costs the GPU that much time per frame.
    void on_rendered(const FrameView& view, const gaze::FrameFovea& fovea) override;

    /// Whether there was a frame.
    [[nodiscard]] bool any() const { return last_.has_value(); }

    /// For each eye: EYE-result.png, and what lies between scene and result (EYE-lp.png: the
    /// LP-buffer, black where the plan left texels out). With `full`, a renderer of the same scene
    /// at full resolution, also EYE-full.png and EYE-difference.png. Null: what was shown is full
    /// resolution, and is written as EYE-full.png. Returns the files written. Errors (BadInput):
    /// the folder or a file cannot be written. Precondition: any().
    Expected<std::vector<std::filesystem::path>> write(OffScreen* full,
                                                       const SnapshotOptions& options) const;

  private:
    struct Shown {
        FrameView view;
        gaze::FrameFovea fovea;
    };

    const vulkan::Context* context_;
    const FrameRenderer* renderer_;
    gaze::PerEye<vulkan::ColorImage> copies_;
    vk::raii::CommandPool pool_{nullptr};
    vk::raii::CommandBuffer commands_{nullptr};
    vk::raii::Semaphore copied_{nullptr};
    std::uint64_t copies_made_ = 0;
    std::optional<Shown> last_;
};

}  // namespace gazeloop::render

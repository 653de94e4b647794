#include "runtime/vulkan/history.h"

namespace gazeloop::vulkan {

History::History(const Context& context, vk::Extent2D extent, vk::Format format) {
    for (Entry& entry : images_) {
        entry.image =
            ColorImage(context, extent, format,
                       vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eSampled);
        entry.tracked = TrackedImage(entry.image.image(), vk::ImageAspectFlagBits::eColor);
    }
}

void History::advance() {
    newest_ = 1 - newest_;
    ++frames_;
}

}  // namespace gazeloop::vulkan

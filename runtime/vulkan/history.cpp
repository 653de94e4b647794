#include "runtime/vulkan/history.h"

namespace gazeloop::vulkan {

History::History(const Context& context, vk::Extent2D extent, vk::Format format,
                 vk::ImageUsageFlags read) {
    for (Entry& entry : images_) {
        entry = Entry(
            context, extent, format,
            vk::ImageUsageFlagBits::eColorAttachment | read | vk::ImageUsageFlagBits::eTransferSrc);
    }
}

void History::advance() {
    newest_ = 1 - newest_;
    ++frames_;
}

}  // namespace gazeloop::vulkan

#include "runtime/scene/light_field_views.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "runtime/error.h"
#include "runtime/memory/scratch_file.h"
#include "runtime/scene/block_compression.h"
#include "runtime/vulkan/layer_uploads.h"
#include "runtime/vulkan/memory.h"

namespace gazeloop::scene {
namespace {

/// Views that are fetched ahead at a time: of heads that move by up to .4 m/s before two lenses of
/// 10 mm on cameras 5 mm apart, at 90 Hz, fewer leave more frames waiting, and more do not help
/// (LikelyViews.SpareFramesTheirWaits).
constexpr std::uint32_t kMostAhead = 12;

constexpr auto kUsage = vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst;

vulkan::LayeredImage::Form form_of(const LightFieldSource& source, const LightFieldMemory& memory,
                                   std::uint32_t layers) {
    return {.extent = vk::Extent2D(source.width_px, source.height_px),
            .format = memory.compressed ? vk::Format::eBc1RgbSrgbBlock : vk::Format::eR8G8B8A8Srgb,
            .usage = kUsage,
            .layers = layers,
            .view = vk::ImageViewType::e2DArray};
}

std::uint64_t bytes_of_view(const LightFieldSource& source, const LightFieldMemory& memory) {
    return memory.compressed ? bc1_bytes(source.width_px, source.height_px)
                             : std::uint64_t{4} * source.width_px * source.height_px;
}

LightFieldStorage storage_for(const vulkan::Context& context, const LightFieldSource& source,
                              const light_field::Lens& lens, const LightFieldMemory& memory) {
    const vulkan::LayeredImage::Form one = form_of(source, memory, 1);
    constexpr auto kNeeded = vk::FormatFeatureFlagBits::eSampledImage |
                             vk::FormatFeatureFlagBits::eSampledImageFilterLinear |
                             vk::FormatFeatureFlagBits::eTransferDst;
    const auto features = context.physical().getFormatProperties(one.format).optimalTilingFeatures;
    if (memory.compressed && (!context.has_bc_textures() || (features & kNeeded) != kNeeded)) {
        throw SetupError(ErrorKind::BadInput,
                         fmt::format("{} reads no textures in BC1: lightfield.compression = none",
                                     context.device_name()));
    }
    const vk::ImageFormatProperties most = context.physical().getImageFormatProperties(
        one.format, vk::ImageType::e2D, vk::ImageTiling::eOptimal, kUsage);
    if (one.extent.width > most.maxExtent.width || one.extent.height > most.maxExtent.height) {
        throw SetupError(
            ErrorKind::BadInput,
            fmt::format("{}: views of {}x{} px are larger than an image of this device, {} px a "
                        "side",
                        source.name, source.width_px, source.height_px, most.maxExtent.width));
    }
    return value_or_throw(choose_storage(
        {.cameras = source.cameras, .lens = lens},
        {.name = source.name,
         .width_px = source.width_px,
         .height_px = source.height_px,
         .bytes = bytes_of_view(source, memory),
         .compressed = memory.compressed},
        {.most_bytes = memory.most_bytes,
         .most_layers = most.maxArrayLayers,
         .image_bytes =
             [&](std::uint32_t layers) {
                 return vulkan::memory_needed(context, form_of(source, memory, layers));
             },
         .most_image_bytes = std::min(most.maxResourceSize, vulkan::most_memory(context)),
         .most_ahead = memory.fetch_ahead ? kMostAhead : 0}));
}

/// What is said of views that are fetched ahead.
std::string ahead_text(const LightFieldMemory& memory, const LightFieldStorage& storage) {
    if (storage.ahead > 0) {
        return fmt::format("; up to {} are fetched ahead in each", storage.ahead);
    }
    return memory.fetch_ahead ? "; none is fetched ahead, for which there is no room" : "";
}

}  // namespace

LightFieldViews::LightFieldViews(const vulkan::Context& context, const LightFieldSource& source,
                                 const light_field::Lens& lens, const LightFieldMemory& memory)
    : view_bytes_(bytes_of_view(source, memory)),
      views_(source.cameras.count()),
      storage_(storage_for(context, source, lens, memory)),
      image_(context, form_of(source, memory, storage_.layers)) {
    vulkan::make_readable(context, image_);
    LightFieldSource::Prepare prepare;
    if (memory.compressed) {
        prepare = [&](const LightFieldSource::Texels& texels) {
            const auto blocks = compress_bc1(texels, source.width_px, source.height_px);
            return LightFieldSource::Texels(blocks.begin(), blocks.end());
        };
    }
    if (!storage_.streamed) {
        load_all(context, source, prepare);
        return;
    }
    memory::ScratchFile file = value_or_throw(memory::ScratchFile::make());
    value_or_throw(file.reserve(views_ * view_bytes_));
    value_or_throw(source.read(prepare, [&](std::uint32_t view, const auto& texels) {
        return file.write(view * view_bytes_, texels);
    }));
    stream_.emplace(context, image_, std::move(file), views_, view_bytes_, storage_);
    spdlog::info(
        "{}: {} views take {} MiB, more than they may (lightfield.memory_mib): {} at a time are "
        "kept, in {} MiB, and frames wait for others{}",
        source.name, views_, (views_ * view_bytes_) >> 20U, storage_.layers, memory_bytes() >> 20U,
        ahead_text(memory, storage_));
}

void LightFieldViews::load_all(const vulkan::Context& context, const LightFieldSource& source,
                               const LightFieldSource::Prepare& prepare) {
    vulkan::HostBuffer staging(context, storage_.staged * view_bytes_,
                               vk::BufferUsageFlagBits::eTransferSrc);
    vulkan::LayerUploads uploads(context);
    std::vector<vulkan::LayerSource> staged;
    const auto flush = [&] {
        uploads.wait(uploads.submit(image_, staging.buffer(), staged));
        staged.clear();
    };
    value_or_throw(source.read(prepare, [&](std::uint32_t view, const auto& texels) {
        const std::uint64_t offset = staged.size() * view_bytes_;
        staging.write(std::span<const std::byte>(texels), offset);
        staged.push_back({view, offset});
        if (staged.size() == storage_.staged) {
            flush();
        }
        return Expected<void>{};
    }));
    if (!staged.empty()) {
        flush();
    }
}

void LightFieldViews::bring(std::span<const std::uint32_t> wanted) {
    if (stream_) {
        stream_->bring(wanted);
    }
}

void LightFieldViews::fetch_ahead(std::span<const std::uint32_t> likely) {
    if (stream_) {
        stream_->fetch_ahead(likely);
    }
}

std::uint64_t LightFieldViews::memory_bytes() const {
    return image_.memory_bytes() + (stream_ ? stream_->memory_bytes() : 0);
}

std::optional<std::string> LightFieldViews::account() const {
    if (!stream_) {
        return std::nullopt;
    }
    return fmt::format("{} of {} views at a time, in {} MiB: {}", storage_.layers, views_,
                       memory_bytes() >> 20U, stream_->account());
}

}  // namespace gazeloop::scene

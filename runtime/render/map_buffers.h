#pragma once

#include "runtime/foveation/log_polar/map_tables.h"
#include "runtime/vulkan/memory.h"

namespace gazeloop::render {

/// A map's tables on the GPU, as shaders/lib/log_polar.glsl binds them. No gaze changes them.
class MapBuffers {
  public:
    MapBuffers(const vulkan::Context& context, const foveation::MapTables& tables);

    [[nodiscard]] vk::Buffer map_tables() const { return map_tables_.buffer(); }
    [[nodiscard]] vk::Buffer column_table() const { return column_table_.buffer(); }
    [[nodiscard]] vk::Buffer row_table() const { return row_table_.buffer(); }

  private:
    vulkan::HostBuffer map_tables_;
    vulkan::HostBuffer column_table_;
    vulkan::HostBuffer row_table_;
};

}  // namespace gazeloop::render

#include "runtime/scene/scene_file.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "runtime/error.h"
#include "runtime/scene/gltf/load_gltf.h"
#include "runtime/scene/gltf/viewer_place.h"

namespace gazeloop::scene {
namespace {

using Clock = std::chrono::steady_clock;

/// Says how far a load is.
class Progress {
  public:
    explicit Progress(std::string name)
        : name_(std::move(name)), is_shown_(spdlog::should_log(spdlog::level::info)) {}
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    ~Progress() {
        if (is_line_open_) {
            fmt::print(stderr, "\r\x1B[K");
        }
    }

    void tell(std::size_t done, std::size_t total) {
        constexpr auto kBetween = std::chrono::seconds(2);
        if (!is_shown_) {
            return;
        }
        if (is_terminal_) {
            fmt::print(stderr, "\r\x1B[Kloading {}: {} of {} pictures and shapes", name_, done,
                       total);
            std::fflush(stderr);
            is_line_open_ = true;
        } else if (const auto now = Clock::now(); now - last_ >= kBetween) {
            spdlog::info("loading {}: {} of {} pictures and shapes", name_, done, total);
            last_ = now;
        }
    }

  private:
    std::string name_;
    bool is_shown_;
    bool is_terminal_ = isatty(STDERR_FILENO) != 0;
    bool is_line_open_ = false;
    Clock::time_point last_ = Clock::now();
};

/// Of what is shown in its finest form.
std::uint64_t triangle_count(const mesh::MeshData& data) {
    std::uint64_t count = 0;
    for (const mesh::Instance& instance : data.instances) {
        count += data.primitives[data.levels[instance.first_level].primitive].index_count / 3;
    }
    return count;
}

}  // namespace

bool is_scene_file(std::string_view name) {
    return std::ranges::any_of(kSceneFileExtensions, [&](std::string_view extension) {
        return name.size() > extension.size() && name.ends_with(extension);
    });
}

mesh::MeshData load_scene_file(const std::filesystem::path& file) {
    const Clock::time_point begin = Clock::now();
    const auto load = [&] {
        Progress progress(file.filename().string());
        gltf::LoadOptions options;
        options.progress = [&](std::size_t done, std::size_t total) { progress.tell(done, total); };
        return value_or_throw(gltf::load_gltf(file, options));
    };
    gltf::LoadedScene scene = load();
    spdlog::info("{}: {} triangles in {} instances, {} pictures, loaded in {:.1f} s", file.string(),
                 triangle_count(scene.data), scene.data.instances.size(), scene.data.images.size(),
                 std::chrono::duration<double>(Clock::now() - begin).count());
    for (const gltf::Note& note : scene.notes) {
        spdlog::warn("{}: {}", file.string(), note_text(note));
    }
    gltf::place_before_viewer(scene.data);
    return std::move(scene.data);
}

}  // namespace gazeloop::scene

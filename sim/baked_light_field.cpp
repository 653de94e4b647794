#include "sim/baked_light_field.h"

#include <fmt/format.h>
#include <signal.h>
#include <spdlog/spdlog.h>
#include <unistd.h>
#include <xxhash.h>

#include <cerrno>
#include <charconv>
#include <span>
#include <string>

#include "runtime/files/cache_folder.h"
#include "runtime/scene/light_field_file.h"
#include "shaders/shader_library.h"

namespace gazeloop::sim {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kScene = "raymarch";

/// Another one for another picture.
std::string folder_name(const LightFieldBake& bake) {
    const std::span<const std::uint32_t> shader =
        shaders::spirv(fmt::format("{}.full.frag", kScene));
    const std::string of_bake =
        fmt::format("{} {} {}", bake.samples, bake.field_deg, bake.scene_time_s);
    return fmt::format("light-field-{}-{}-{}um-{:016x}", bake.views, bake.size_px,
                       bake.spacing_m * 1e6,
                       XXH3_64bits_withSeed(of_bake.data(), of_bake.size(),
                                            XXH3_64bits(shader.data(), shader.size_bytes())));
}

/// Folders that were being made are named by the process.
void remove_what_killed_programs_left(const fs::path& folder) {
    const std::string begin = folder.filename().string() + '.';
    std::error_code error;
    for (const fs::directory_entry& one : fs::directory_iterator(folder.parent_path(), error)) {
        const std::string name = one.path().filename().string();
        pid_t process = 0;
        const char* const end = name.data() + name.size();
        if (name.starts_with(begin) &&
            std::from_chars(name.data() + begin.size(), end, process).ptr == end && process > 0 &&
            (process == getpid() || (kill(process, 0) != 0 && errno == ESRCH))) {
            fs::remove_all(one.path(), error);
        }
    }
}

}  // namespace

Expected<fs::path> baked_light_field(const vulkan::Context& context, const LightFieldBake& bake,
                                     const fs::path& cache, const std::function<bool()>& go_on) {
    const fs::path folder = cache / folder_name(bake);
    fs::path file = folder / fmt::format("views{}", scene::kLightFieldExtension);
    std::error_code error;
    if (fs::exists(file, error)) {
        return file;
    }
    if (fs::exists(folder, error)) {
        return std::unexpected(
            Error{ErrorKind::BadInput,
                  fmt::format("{}: is there without {}: remove it, and it is rendered again",
                              folder.string(), file.filename().string())});
    }
    remove_what_killed_programs_left(folder);
    spdlog::info("the scene {}: rendering its {} views of {}x{} px into {}, once",
                 scene::kBakedLightField, bake.views * bake.views, bake.size_px, bake.size_px,
                 folder.string());
    // Whole or not at all, whoever else makes it at this time.
    const fs::path partial = fmt::format("{}.{}", folder.string(), getpid());
    const auto scene = scene::make_scene(context, kScene);
    auto baked = bake_light_field(context, *scene, bake, partial,
                                  [&](std::uint32_t done, std::uint32_t total) {
                                      if (done % (5 * bake.views) < 2) {
                                          spdlog::info("{} of {} views", done, total);
                                      }
                                      return go_on();
                                  });
    if (baked) {
        fs::rename(partial, folder, error);
        std::error_code ignored;
        if (!error || fs::exists(file, ignored)) {
            fs::remove_all(partial, ignored);  // another one was first
            return file;
        }
        baked = std::unexpected(
            Error{ErrorKind::BadInput,
                  fmt::format("{}: cannot be made ({})", folder.string(), error.message())});
    }
    fs::remove_all(partial, error);
    Error why = baked.error();
    if (why.kind == ErrorKind::BadInput) {
        why.message += "; name a folder that can be written in GAZELOOP_CACHE";
    }
    return std::unexpected(why);
}

std::unique_ptr<scene::Scene> make_scene(const vulkan::Context& context, std::string_view name,
                                         const scene::SceneOptions& options,
                                         const std::function<bool()>& go_on) {
    if (name != scene::kBakedLightField) {
        return scene::make_scene(context, name, options);
    }
    const fs::path file =
        value_or_throw(baked_light_field(context, kBuiltInBake, files::cache_folder(), go_on));
    try {
        return scene::make_scene(context, file.string(), options);
    } catch (const SetupError& wrong) {
        // Its views are nobody's but this program's.
        if (wrong.kind() != ErrorKind::BadInput) {
            throw;
        }
        throw SetupError(wrong.kind(),
                         fmt::format("{}; if its views are damaged, remove {}, and they are "
                                     "rendered again",
                                     wrong.what(), file.parent_path().string()));
    }
}

}  // namespace gazeloop::sim

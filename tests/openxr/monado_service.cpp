#include "tests/openxr/monado_service.h"

#include <filesystem>

#include "tests/support/cache_folder.h"

namespace gazeloop::tests {
namespace {

BackgroundProcess::Options service_options(const ScratchFolder& scratch, const Environment& more) {
    BackgroundProcess::Options options{
        .command = {MonadoService::folder().value_or("") + "/bin/monado-service"},
        .environment = MonadoService::client_environment(scratch),
        .output_file = scratch.file("service.log"),
        .with_input = true};
    options.environment.insert(options.environment.end(), {{"SIMULATED_ENABLE", "1"},
                                                           {"GAZELOOP_HEAD_STILL", "1"},
                                                           {"XRT_COMPOSITOR_LOG", "warn"},
                                                           {"PROBER_LOG", "warn"},
                                                           {"XRT_NO_STDIN", ""}});
    options.environment.insert(options.environment.end(), more.begin(), more.end());
    return options;
}

}  // namespace

std::optional<std::string> MonadoService::folder() {
    const std::string folder = cache_folder() + "/monado-service";
    return std::filesystem::exists(folder + "/bin/monado-service") ? std::optional(folder)
                                                                   : std::nullopt;
}

Environment MonadoService::client_environment(const ScratchFolder& scratch) {
    return {{"XDG_RUNTIME_DIR", std::filesystem::path(scratch.file(".")).parent_path().string()},
            {"XR_RUNTIME_JSON", folder().value_or("") + "/share/openxr/1/openxr_monado.json"},
            {"XRT_LOG", "error"},
            {"OXR_NO_PRINTING", "1"},
            {"U_PACING_APP_USE_MIN_FRAME_PERIOD", "1"}};
}

MonadoService::MonadoService(const ScratchFolder& scratch, const Environment& more)
    : process_(service_options(scratch, more)),
      ready_(process_.says("service has started", std::chrono::seconds(60))) {}

}  // namespace gazeloop::tests

// Any bytes as a configuration file: settings, or an error that names the file. What was set can be
// read back from a configuration file of its own.
#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "runtime/run/program_settings.h"
#include "tests/support/temporary_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gazeloop;
    static const tests::TemporaryFolder folder;
    const auto file = folder / "config.toml";
    std::ofstream(file, std::ios::binary | std::ios::trunc)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    run::ProgramSettings settings;
    const Expected<void> loaded = settings.load(file);
    if (!loaded) {
        const Error& error = loaded.error();
        if ((error.kind != ErrorKind::BadInput && error.kind != ErrorKind::Usage) ||
            error.message.find(file.string()) == std::string::npos) {
            std::abort();
        }
        return 0;
    }
    (void)settings.check();
    (void)settings.describe();
    run::ProgramSettings again;
    for (const auto& [key, value] : settings.list()) {
        if (!again.set(key, value, "again")) {
            std::abort();
        }
    }
    for (std::size_t i = 0; i < settings.list().size(); ++i) {
        if (again.list()[i].value != settings.list()[i].value) {
            std::abort();
        }
    }
    return 0;
}

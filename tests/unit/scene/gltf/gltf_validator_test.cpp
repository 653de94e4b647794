// The reader's verdict on files beside that of Khronos' glTF validator, which npm has.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "runtime/environment.h"
#include "tests/support/cache_folder.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/scene/gltf/loaded.h"
#include "tests/unit/scene/gltf/spoiled_files.h"

namespace gazeloop::tests {
namespace {

constexpr const char* kValidator = "gltf-validator@2.0.0-dev.3.10";

/// Prints one line per file: its name, then the codes of its errors and warnings.
constexpr const char* kScript = R"js(
const fs = require('fs');
const path = require('path');
const validator = require('gltf-validator');
(async () => {
    for (const file of process.argv.slice(2)) {
        const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), {
            uri: path.basename(file), maxIssues: 0,
            externalResourceFunction: async uri => new Uint8Array(
                fs.readFileSync(path.join(path.dirname(file), decodeURIComponent(uri))))
        }).catch(error => ({issues: {messages: [{severity: 0, code: String(error).split('\n')[0]}]}}));
        const codes = report.issues.messages.filter(m => m.severity <= 1).map(m => m.code);
        console.log([path.basename(file), ...new Set(codes)].join(' '));
    }
})();
)js";

/// Valid files that we refuse or note, and why.
const std::map<std::string, std::string> kDifferences{
    {"draco", "a required extension that is not supported"},
    {"optional_extension", "an extension that is not supported"},
    {"far_away", "single precision"},
    {"too_large_a_number", "single precision"},
    {"flat", "what is not shown is told"},
    {"no_default_scene", "a choice that is made is told"},
    {"no_scene", "nothing to show"},
    {"nothing_to_show", "nothing to show"},
    {"no_binary_chunk", "a buffer that nobody gives is needed"}};

std::string in_path(const char* name) {
    const char* const path = std::getenv("PATH");
    for (const std::string& folder : split_list(path != nullptr ? path : "")) {
        const std::filesystem::path program = std::filesystem::path(folder) / name;
        if (std::filesystem::exists(program)) {
            return program.string();
        }
    }
    return "";
}

/// A folder with the validator, fetched once; empty: why not, in `reason`.
std::string validator_folder(std::string& reason) {
    const std::filesystem::path folder = std::filesystem::path(cache_folder()) / "npm";
    if (std::filesystem::exists(folder / "node_modules/gltf-validator")) {
        return folder.string();
    }
    const std::string npm = in_path("npm");
    if (npm.empty()) {
        reason = "npm is not there";
        return "";
    }
    std::filesystem::create_directories(folder);
    const ProgramResult result = run_program(
        {npm, "install", "--no-audit", "--no-fund", "--prefix", folder.string(), kValidator},
        {.timeout = std::chrono::seconds(40)});
    if (result.exit_code != 0) {
        reason = std::string("npm cannot fetch ") + kValidator;
        return "";
    }
    return folder.string();
}

TEST(GltfValidator, JudgesAsWeDo) {
    std::string reason;
    const std::string node = in_path("node");
    const std::string validator = validator_folder(reason);
    if (node.empty() || validator.empty()) {
        GTEST_SKIP() << (node.empty() ? "node is not there" : reason);
    }
    const TemporaryFolder folder;
    std::map<std::string, GltfFile> files{{"untouched", one_triangle()}};
    for (const SpoiledFile& file : kRefused) {
        files[file.name] = patched(file.patch);
    }
    for (const SpoiledFile& file : kNoted) {
        files[file.name] = patched(file.patch);
    }
    std::ofstream(folder / "validate.js") << kScript;
    const GltfFile plain = one_triangle();
    std::ofstream(folder / "scene.bin")
        .write(reinterpret_cast<const char*>(plain.binary.data()),
               static_cast<std::streamsize>(plain.binary.size()));
    std::vector<std::string> command{node, folder / "validate.js"};
    for (const auto& [name, file] : files) {
        const std::filesystem::path path = folder / (name + ".gltf");
        std::ofstream(path) << file.text();
        command.push_back(path.string());
    }
    const ProgramResult result =
        run_program(command, {.environment = {{"NODE_PATH", validator + "/node_modules"}}});
    ASSERT_EQ(result.exit_code, 0) << result.err;

    std::istringstream lines(result.out);
    std::size_t judged = 0;
    for (std::string line; std::getline(lines, line); ++judged) {
        std::istringstream words(line);
        std::string file_name;
        words >> file_name;
        const std::string name = file_name.substr(0, file_name.find(".gltf"));
        std::string codes;
        std::getline(words, codes);
        const auto ours = try_to_load(files.at(name));
        const std::string said = ours ? notes_of(*ours) : ours.error().message;
        if (const auto difference = kDifferences.find(name); difference != kDifferences.end()) {
            EXPECT_NE(codes.empty(), said.empty())
                << name << " no longer differs: " << difference->second;
        } else {
            EXPECT_EQ(codes.empty(), said.empty())
                << name << ": the validator says '" << codes << "', we say '" << said << "'";
        }
    }
    EXPECT_EQ(judged, files.size());
}

}  // namespace
}  // namespace gazeloop::tests

// `gazeloop numerics` as users run it: it measures this device, and says whether the targets are
// met.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

namespace gazeloop::tests {
namespace {

TEST(Numerics, MeetsItsTargetsAndReportsThem) {
    const TemporaryFolder folder;
    const std::string html = (folder / "n.html").string();
    const std::string json = (folder / "n.json").string();
    const ProgramResult result =
        run_gazeloop({"numerics", "--quick", "--html", html, "--json", json});
    EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
    EXPECT_NE(result.out.find("acuity m=0.022"), std::string::npos);

    std::ifstream in(json);
    const nlohmann::json envelope = nlohmann::json::parse(in);
    EXPECT_TRUE(envelope["met"]);
    EXPECT_EQ(envelope["draws_not_finite"], 0);
    EXPECT_GT(envelope["rows"].size(), 40U);
    for (const nlohmann::json& row : envelope["rows"]) {
        EXPECT_GT(row["device"]["forward_px"], 0.0);  // measured, not assumed
        EXPECT_LE(row["device"]["forward_px"], row["forward_bound_px"]);
        EXPECT_LE(row["float"]["inverse_px"], row["inverse_bound_px"]);
        EXPECT_EQ(row["beyond_bound"], 0);
    }

    std::ifstream page(html);
    std::stringstream text;
    text << page.rdbuf();
    EXPECT_NE(text.str().find("<svg"), std::string::npos);
    EXPECT_EQ(text.str().find("http"), std::string::npos);  // it needs no network
}

TEST(Numerics, SaysWhatItCannotWrite) {
    const ProgramResult result =
        run_gazeloop({"numerics", "--quick", "--quiet", "--html", "/nowhere/n.html"});
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_NE(result.err.find("/nowhere/n.html"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace gazeloop::tests

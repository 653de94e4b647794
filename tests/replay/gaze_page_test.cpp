// `gazeloop gaze --html`, `--events` and `--json` as users see them.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "tests/support/run_program.h"

namespace gazeloop::tests {
namespace {

using nlohmann::json;

std::string text_of(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
}

class RecordedGazePage : public testing::Test {
  protected:
    std::string simulated(const std::string& name) {
        const std::string file = folder_.file(name);
        const ProgramResult made = run_gazeloop(
            {"simulate", "gaze", file, "--seconds", "30", "--rate", "250", "--seed", "4"});
        EXPECT_EQ(made.exit_code, 0) << made.err;
        return file;
    }

    ScratchFolder folder_;
};

TEST_F(RecordedGazePage, WritesEveryEventOnceAndCountsThem) {
    const std::string events = folder_.file("events.csv");
    const ProgramResult result =
        run_gazeloop({"gaze", simulated("g.csv"), "--events", events, "--json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const json found = json::parse(result.out)["events"];
    std::istringstream lines(text_of(events));
    std::string line;
    std::getline(lines, line);
    EXPECT_TRUE(line.starts_with("event,begin_s,end_s,")) << line;
    std::size_t saccades = 0;
    std::string end_s;
    while (std::getline(lines, line)) {
        saccades += line.starts_with("saccade,") ? 1 : 0;
        const std::size_t begin = line.find(',') + 1;
        const std::string begin_s = line.substr(begin, line.find(',', begin) - begin);
        if (!end_s.empty()) {
            EXPECT_EQ(begin_s, end_s) << "no time between events";
        }
        const std::size_t end = line.find(',', begin) + 1;
        end_s = line.substr(end, line.find(',', end) - end);
    }
    EXPECT_EQ(found["saccades"]["count"], saccades);
    EXPECT_GT(saccades, 40U);
    EXPECT_NEAR(found["main_sequence"]["peak_over_published"], 1.0, 0.15);
}

TEST_F(RecordedGazePage, RefusesOutputsThatAreOne) {
    const std::string trace = simulated("g.csv");
    EXPECT_EQ(run_gazeloop({"gaze", trace, "--html", trace}).exit_code, 2);
    EXPECT_EQ(run_gazeloop({"gaze", trace, "--html", "-", "--json"}).exit_code, 2);
    EXPECT_EQ(run_gazeloop({"gaze", trace, trace, "--events", folder_.file("e.csv")}).exit_code, 2);
    EXPECT_EQ(run_gazeloop({"gaze", trace, "--html", "/nowhere/p.html"}).exit_code, 3);
}

constexpr const char* kLook = R"js(<script>
async function look() {
  const verdict = document.getElementById("page-verdict");
  for (let i = 0; i < 100 && verdict.dataset.state === "no script"; ++i) {
    await new Promise((done) => setTimeout(done, 50));
  }
  const figures = [...document.querySelectorAll("figure")];
  const found = {state: verdict.dataset.state, figures: figures.length, drawn: Number(verdict.dataset.plots),
    empty: document.querySelectorAll("figure.empty").length,
    tables: figures.filter((figure) => figure.querySelector("details table")).length};
  document.querySelector("figure .plot").dispatchEvent(new KeyboardEvent("keydown", {key: "+", bubbles: true}));
  const before = document.getElementById("shown").textContent;
  await new Promise((done) => setTimeout(done, 100));
  found.zoomed = document.getElementById("shown").textContent !== before;
  const result = document.createElement("pre");
  result.id = "test-result";
  result.textContent = JSON.stringify(found);
  document.body.append(result);
}
look();
</script>
</body>)js";

TEST_F(RecordedGazePage, DrawsAPageOfOneRecordingAndOfTwo) {
    ASSERT_EQ(run_program({"chromium", "--version"}).exit_code, 0)
        << "no chromium: ./dev test installs it";
    const std::string trace = simulated("g.csv");
    for (const std::vector<std::string>& recordings :
         {std::vector<std::string>{trace}, std::vector<std::string>{trace, trace}}) {
        const std::string file = folder_.file("page.html");
        std::vector<std::string> command{"gaze"};
        command.insert(command.end(), recordings.begin(), recordings.end());
        command.insert(command.end(), {"--html", file});
        ASSERT_EQ(run_gazeloop(command).exit_code, 0);
        std::string page = text_of(file);
        page.replace(page.rfind("</body>"), std::string_view("</body>").size(), kLook);
        const ProgramResult seen =
            run_program({"chromium", "--headless=new", "--no-sandbox", "--disable-gpu",
                         "--user-data-dir=" + folder_.file("profile"), "--enable-logging=stderr",
                         "--virtual-time-budget=20000", "--dump-dom",
                         "file://" + folder_.write("looked-at.html", page)});
        EXPECT_EQ(seen.err.find("CONSOLE"), std::string::npos) << seen.err;
        const std::string mark = "<pre id=\"test-result\">";
        const std::size_t begin = seen.out.find(mark);
        ASSERT_NE(begin, std::string::npos) << seen.err;
        const std::size_t from = begin + mark.size();
        const json found = json::parse(seen.out.substr(from, seen.out.find("</pre>", from) - from));
        EXPECT_EQ(found["state"], "drawn");
        EXPECT_EQ(found["figures"], recordings.size() == 1 ? 10 : 23);
        EXPECT_EQ(found["drawn"], found["figures"]);
        EXPECT_EQ(found["tables"], found["figures"]) << "every plot has its numbers beside it";
        EXPECT_EQ(found["zoomed"], recordings.size() == 1);  // the first of two is over lags
    }
}

}  // namespace
}  // namespace gazeloop::tests

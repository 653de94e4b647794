// `gazeloop report --html` as users see it: opened in a browser, plots drawn, numbers as in --json.
#include <fmt/format.h>
#include <gtest/gtest.h>

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

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// Waits for the page's own verdict, looks at every plot at several zooms, and reads the stages.
constexpr const char* kLook = R"js(<script>
async function look() {
  const wait = (ms) => new Promise((done) => setTimeout(done, ms));
  const verdict = document.getElementById("page-verdict");
  for (let i = 0; i < 100 && verdict.dataset.state === "no script"; ++i) {
    await wait(50);
  }
  const drawn = () => Object.fromEntries([...document.querySelectorAll("figure")].map((figure) => {
    const canvas = figure.querySelector("canvas");
    if (canvas === null) {
      return [figure.id, -1];
    }
    const copy = document.createElement("canvas");
    [copy.width, copy.height] = [canvas.width, canvas.height];
    const pen = copy.getContext("2d", {willReadFrequently: true});  // else the browser warns
    pen.drawImage(canvas, 0, 0);
    const {data} = pen.getImageData(0, 0, copy.width, copy.height);
    let coloured = 0;  // neither transparent nor of a grid's or a label's grey
    for (let i = 0; i < data.length; i += 4) {
      const spread = Math.max(data[i], data[i + 1], data[i + 2]) - Math.min(data[i], data[i + 1], data[i + 2]);
      coloured += data[i + 3] > 0 && spread > 40 ? 1 : 0;
    }
    return [figure.id, coloured];
  }));
  const press = (selector, key) => document.querySelector(selector)
    .dispatchEvent(new KeyboardEvent("keydown", {key, bubbles: true}));
  const shown = () => document.getElementById("shown").textContent;
  const found = {all: drawn(), shown_all: shown()};
  for (let i = 0; i < 3; ++i) {
    press("#age .plot", "+");
  }
  await wait(100);
  found.zoomed = drawn();
  found.shown_zoomed = shown();
  press("#age .plot", "Home");
  await wait(100);
  found.shown_home = shown();
  const first = document.querySelector("button.show");
  if (first) {
    first.click();
    await wait(100);
  }
  found.shown_worst = shown();
  found.stages = Object.fromEntries([...document.querySelectorAll("#stages-table tr[data-row]")].map(
    (row) => [row.dataset.row, [...row.querySelectorAll("td")].map((cell) => cell.textContent)]));
  found.heads = [...document.querySelectorAll("#stages-table thead th")].map((head) => head.textContent);
  found.worst = [...document.querySelectorAll("#worst thead button")].map((head) => head.textContent);
  found.unreachable = [...document.querySelectorAll("figure")].filter(
    (figure) => figure.querySelector(".plot").tabIndex !== 0 || figure.querySelector("table, details p") === null).length;
  found.images = document.images.length;
  found.wide = document.documentElement.scrollWidth - document.documentElement.clientWidth;
  found.state = verdict.dataset.state;
  found.verdict = verdict.textContent;
  const result = document.createElement("pre");
  result.id = "test-result";
  result.textContent = JSON.stringify(found);
  document.body.append(result);
}
look();
</script>
</body>)js";

class ReportPage : public testing::Test {
  protected:
    void SetUp() override {
        ASSERT_EQ(run_program({"chromium", "--version"}).exit_code, 0)
            << "no chromium: ./dev test installs it";
    }

    std::string recorded(const std::string& name) {
        const std::string session = folder_.file(name);
        const ProgramResult run = run_gazeloop(
            {"run", "--gaze", "sim", "--target", "headless", "--clock", "virtual", "--frames",
             "400", "--set", "render.scale=0.02", "--seed", "3", "--record", session, "--quiet"});
        EXPECT_EQ(run.exit_code, 0) << run.err;
        return session;
    }

    /// The page and the JSON of a session.
    std::string page_of(const std::string& session) {
        const std::string page = folder_.file("page.html");
        const ProgramResult result = run_gazeloop(
            {"report", session, "--html", page, "--json", folder_.file("report.json"), "--quiet"});
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return text_of(page);
    }

    [[nodiscard]] json report() const { return json::parse(text_of(folder_.file("report.json"))); }

    /// What a browser makes of it.
    json seen(std::string page) {
        const std::size_t end = page.rfind("</body>");
        EXPECT_NE(end, std::string::npos);
        page.replace(end, std::string_view("</body>").size(), kLook);
        const std::string file = folder_.write("looked-at.html", page);
        const ProgramResult result =
            run_program({"chromium", "--headless=new", "--no-sandbox", "--disable-gpu",
                         "--user-data-dir=" + folder_.file("profile"), "--enable-logging=stderr",
                         "--window-size=1280,900", "--virtual-time-budget=20000", "--dump-dom",
                         "file://" + file});
        EXPECT_FALSE(has(result.err, "CONSOLE")) << result.err;
        const std::string mark = "<pre id=\"test-result\">";
        const std::size_t begin = result.out.find(mark);
        if (begin == std::string::npos) {
            ADD_FAILURE() << "the page was not looked at: " << result.err;
            return {};
        }
        const std::size_t from = begin + mark.size();
        return json::parse(result.out.substr(from, result.out.find("</pre>", from) - from));
    }

    ScratchFolder folder_;
};

std::string shown(const json& value) {
    return value.is_null() ? "-" : fmt::format("{:.2f}", value.get<double>());
}

TEST_F(ReportPage, DrawsEveryPlotAndSaysWhatTheJsonSays) {
    const std::string page = page_of(recorded("s.gaze"));
    EXPECT_LT(page.size(), 5'000'000U);
    EXPECT_FALSE(has(page, "src=")) << "it loads something";
    const json found = seen(page);
    ASSERT_FALSE(found.is_null());
    EXPECT_EQ(found["state"], "drawn") << found["verdict"];
    for (const char* const view : {"all", "zoomed"}) {
        for (const auto& [plot, coloured] : found[view].items()) {
            if (plot != "clock") {  // a simulated tracker's clock is the host's
                EXPECT_GT(coloured.get<int>(), 50) << plot << ", " << view;
            }
        }
    }
    EXPECT_EQ(found["all"].size(), 9U);
    EXPECT_EQ(found["unreachable"], 0);
    EXPECT_LE(found["wide"].get<int>(), 0) << "the page is wider than its window";
    EXPECT_NE(found["shown_zoomed"], found["shown_all"]);
    EXPECT_EQ(found["shown_home"], found["shown_all"]);
    EXPECT_NE(found["shown_worst"], found["shown_all"]);

    const json told = report();
    ASSERT_EQ(found["heads"].size(), 11U);
    std::size_t rows = 0;
    for (const auto& [group, unit] : {std::pair{"durations", "_ms"}, {"gaze_error", "_degrees"}}) {
        for (const auto& [key, row] : told[group].items()) {
            if (key == "unknown") {
                continue;
            }
            ++rows;
            ASSERT_TRUE(found["stages"].contains(key)) << key;
            const json& cells = found["stages"][key];
            EXPECT_EQ(cells[1], fmt::format("{}", row["frames"].get<std::uint64_t>())) << key;
            for (std::size_t i = 2; i < cells.size(); ++i) {
                const std::string name = found["heads"][i + 1].get<std::string>() + unit;
                ASSERT_TRUE(row.contains(name)) << name;
                EXPECT_EQ(cells[i], shown(row[name])) << key << " " << name;
            }
        }
    }
    EXPECT_EQ(found["stages"].size(), rows);
    ASSERT_EQ(found["worst"].size(), told["worst_frames"].size());
    for (std::size_t i = 0; i < found["worst"].size(); ++i) {
        EXPECT_EQ(found["worst"][i],
                  fmt::format("{}", told["worst_frames"][i]["frame"].get<std::uint64_t>()));
    }
}

TEST_F(ReportPage, TakesNoTextForItsOwnLanguage) {
    const std::string session = recorded("<img src=x onerror=alert(1)>&amp;{{file}}.gaze");
    const ProgramResult changed =
        run_program({"sqlite3", session,
                     "INSERT INTO event SELECT max(position) + 1, time_ns, time_kind, 'tracker', "
                     "'</script><img src=y>' FROM event"});
    EXPECT_EQ(changed.exit_code, 0) << changed.err;
    const json found = seen(page_of(session));
    ASSERT_FALSE(found.is_null());
    EXPECT_EQ(found["state"], "drawn") << found["verdict"];
    EXPECT_EQ(found["images"], 0);
}

TEST_F(ReportPage, IsTrueOfASessionWithoutFrames) {
    const std::string session = recorded("s.gaze");
    const ProgramResult emptied =
        run_program({"sqlite3", session, "DELETE FROM frame; DELETE FROM view; DELETE FROM fovea"});
    EXPECT_EQ(emptied.exit_code, 0) << emptied.err;
    const json found = seen(page_of(session));
    ASSERT_FALSE(found.is_null());
    EXPECT_EQ(found["state"], "drawn") << found["verdict"];
    for (const auto& [plot, coloured] : found["all"].items()) {
        EXPECT_EQ(coloured, -1) << plot;
    }
    for (const auto& [key, cells] : found["stages"].items()) {
        EXPECT_EQ(cells[1], "0") << key;
        EXPECT_EQ(cells[2], "-") << key << ": unknown is never 0";
    }
}

TEST_F(ReportPage, IsTrueOfASessionWithoutGazeOrTimes) {
    const std::string session = recorded("s.gaze");
    const ProgramResult changed = run_program(
        {"sqlite3", session,
         "UPDATE frame SET wake_up_kind = 0, display_kind = 0; UPDATE fovea SET state = 4"});
    EXPECT_EQ(changed.exit_code, 0) << changed.err;
    const json found = seen(page_of(session));
    ASSERT_FALSE(found.is_null());
    EXPECT_EQ(found["state"], "drawn") << found["verdict"];
    EXPECT_EQ(found["all"]["age"], -1);
    EXPECT_GT(found["all"]["states"].get<int>(), 50);
    EXPECT_EQ(found["stages"]["gaze_age_at_display"][2], "-");
    EXPECT_TRUE(has(found["shown_all"], "frame 0")) << found["shown_all"];
}

TEST(ReportPageOutput, IsRefusedBeforeTheWork) {
    const ProgramResult nowhere = run_gazeloop({"report", "no.gaze", "--html", "/nowhere/r.html"});
    EXPECT_EQ(nowhere.exit_code, 3);
    EXPECT_TRUE(has(nowhere.err, "/nowhere/r.html: cannot be written")) << nowhere.err;
    const ProgramResult same = run_gazeloop({"report", "no.gaze", "--html", "-", "--json", "-"});
    EXPECT_EQ(same.exit_code, 2);
    EXPECT_TRUE(has(same.err, "--html and --json both name -")) << same.err;
}

}  // namespace
}  // namespace gazeloop::tests

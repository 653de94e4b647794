#include "runtime/trade/sweep_points.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gazeloop::trade {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> texts(const std::vector<SweepPoint>& points) {
    std::vector<std::string> list;
    list.reserve(points.size());
    for (const SweepPoint& point : points) {
        list.push_back(point.method + ": " + point.settings_text());
    }
    return list;
}

TEST(SweepPoints, AreEveryCombinationOfAMethodsOwnSettings) {
    const auto points = sweep_points(
        {"full", "kfr", "acuity"},
        {{"kfr.sigma", {"1.2", "1.8"}}, {"acuity.mar", {".022"}}, {"kfr.alpha", {"1", "4"}}});
    ASSERT_TRUE(points);
    EXPECT_THAT(texts(*points),
                ElementsAre("full: ", "kfr: kfr.sigma=1.2 kfr.alpha=1",
                            "kfr: kfr.sigma=1.2 kfr.alpha=4", "kfr: kfr.sigma=1.8 kfr.alpha=1",
                            "kfr: kfr.sigma=1.8 kfr.alpha=4", "acuity: acuity.mar=.022"));
}

TEST(SweepPoints, VaryWhatFiltersEveryMethodsPictures) {
    const auto points =
        sweep_points({"full", "kfr"}, {{"kfr.sigma", {"1.8"}}, {"render.taa", {"false", "true"}}});
    ASSERT_TRUE(points);
    EXPECT_THAT(texts(*points), ElementsAre("full: render.taa=false", "full: render.taa=true",
                                            "kfr: kfr.sigma=1.8 render.taa=false",
                                            "kfr: kfr.sigma=1.8 render.taa=true"));
    EXPECT_FALSE(sweep_points({"kfr"}, {{"render.spp", {"1", "4"}}})) << "all points share it";
}

TEST(SweepPoints, RefuseWhatMakesNoSweep) {
    EXPECT_FALSE(sweep_points({}, {}));
    EXPECT_FALSE(sweep_points({"kfr"}, {{"kfr.sigma", {"1"}}, {"kfr.sigma", {"2"}}}));
    const auto foreign = sweep_points({"kfr"}, {{"acuity.mar", {"1"}}});
    ASSERT_FALSE(foreign);
    EXPECT_THAT(foreign.error().message, HasSubstr("acuity.mar"));
    // Of the group of none that is swept, but used by one.
    const auto layers = sweep_points({"layers", "kfr"}, {{"acuity.mar", {"0.02", "0.03"}}});
    ASSERT_TRUE(layers);
    EXPECT_EQ(layers->size(), 3U);
    EXPECT_EQ(sweep_points({"layers", "acuity"}, {{"acuity.mar", {"0.02", "0.03"}}})->size(), 3U);
    EXPECT_FALSE(sweep_points({"kfr"}, {{"kfrx.sigma", {"1"}}}));
    const std::vector<std::string> many(40, "1");
    EXPECT_FALSE(sweep_points({"kfr"}, {{"kfr.sigma", many}, {"kfr.alpha", many}}));
    EXPECT_TRUE(sweep_points({"kfr"}, {{"kfr.sigma", many}}));
}

TEST(Varied, IsReadFromText) {
    const auto varied = parse_varied("kfr.kernel=power,sine");
    ASSERT_TRUE(varied);
    EXPECT_EQ(varied->key, "kfr.kernel");
    EXPECT_THAT(varied->values, ElementsAre("power", "sine"));
    for (const char* const bad :
         {"", "kfr.sigma", "=1", "kfr.sigma=", "kfr.sigma=1,,2", "kfr.sigma=1,", "kfr.sigma=,1"}) {
        const auto refused = parse_varied(bad);
        ASSERT_FALSE(refused) << bad;
        EXPECT_EQ(refused.error().kind, ErrorKind::Usage);
    }
}

}  // namespace
}  // namespace gazeloop::trade

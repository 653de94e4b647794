#include "runtime/study/controls.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <set>

#include "runtime/preview/pressed_ring.h"

namespace gazeloop::study {
namespace {

using present::Button;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::array kDesigns{Design::SameDifferent, Design::Pair, Design::Ramp, Design::Slider,
                              Design::Quest};

TEST(Controls, GiveEachPressAKeyAndAButton) {
    for (const Design design : kDesigns) {
        std::set<Press> by_key;
        for (int key = 1; key < 128; ++key) {
            if (const auto press = press_of(design, static_cast<char>(key))) {
                by_key.insert(*press);
            }
        }
        std::set<Press> by_button;
        for (std::size_t button = 0; button < present::kButtonCount; ++button) {
            if (const auto press =
                    press_of(design, static_cast<Button>(button), Screen::Question)) {
                EXPECT_TRUE(by_button.insert(*press).second);
            }
        }
        const std::vector<Press> presses = TrialClock::presses(design);
        std::set<Press> all(presses.begin(), presses.end());
        all.insert(Press::GoOn);
        EXPECT_EQ(by_key, all);
        EXPECT_EQ(by_button, all);
        for (const Press press : presses) {
            EXPECT_THAT(controls_text(design),
                        HasSubstr(kPressNames[static_cast<std::size_t>(press)]));
        }
    }
    EXPECT_EQ(press_of(Design::Pair, 'S'), Press::Same);
    EXPECT_EQ(press_of(Design::Ramp, 'd'), Press::Down);
    EXPECT_EQ(press_of(Design::SameDifferent, 'd'), Press::Different);
    EXPECT_EQ(press_of(Design::SameDifferent, Button::Third, Screen::Question), std::nullopt);
}

// A controller may have one button.
TEST(Controls, GoOnAfterARestByAnyButton) {
    for (std::size_t button = 0; button < present::kButtonCount; ++button) {
        EXPECT_EQ(press_of(Design::Slider, static_cast<Button>(button), Screen::Rest), Press::GoOn);
    }
}

TEST(PressEdges, CountAButtonThatGoesDown) {
    present::PressEdges edges;
    EXPECT_FALSE(edges.pressed(Button::First, true));  // held since before
    EXPECT_FALSE(edges.pressed(Button::First, false));
    EXPECT_TRUE(edges.pressed(Button::First, true));
    EXPECT_FALSE(edges.pressed(Button::First, true));
    edges.forget();
    EXPECT_FALSE(edges.pressed(Button::First, true));
    EXPECT_FALSE(edges.pressed(Button::Second, false));
    EXPECT_TRUE(edges.pressed(Button::Second, true));
}

TEST(PressedRing, GivesPressesInOrderAndTheLastOnesToALateReader) {
    const auto ring = std::make_unique<preview::PressedRing>();
    preview::PressedReader reader(*ring);
    std::vector<present::Pressed> pressed;
    reader.take(pressed);
    EXPECT_TRUE(pressed.empty());
    ring->add(static_cast<std::uint8_t>('s'));
    ring->add(Button::GoOn);
    reader.take(pressed);
    EXPECT_THAT(pressed, ElementsAre(present::Pressed('s'), present::Pressed(Button::GoOn)));
    pressed.clear();
    for (std::uint32_t i = 0; i < 2 * preview::PressedRing::kPlaces; ++i) {
        ring->add(static_cast<std::uint8_t>(i % 100));
    }
    ring->add(std::uint8_t{0xFF});  // no button of ours
    reader.take(pressed);
    ASSERT_EQ(pressed.size(), preview::PressedRing::kPlaces - 1);
    EXPECT_EQ(pressed.back(), present::Pressed(static_cast<char>(127 % 100)));
    pressed.clear();
    reader.take(pressed);
    EXPECT_TRUE(pressed.empty());
}

}  // namespace
}  // namespace gazeloop::study

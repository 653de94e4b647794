#pragma once

#include <string_view>

namespace gazeloop::probe {

/// What the operator does, step by step; for --help and the begin of a run.
inline constexpr std::string_view kInstructions =
    "How to measure eye-to-photon with a lamp and a phone:\n"
    "  1. Wire a small infrared LED and a visible one to one switch. Hold the infrared one where "
    "it\n"
    "     shines into the tracker's camera and blinds it, never close to an eye.\n"
    "  2. Put the headset on, or an artificial eye into it, and start this command. The black "
    "square\n"
    "     straight ahead is the patch: it goes white while the tracker has lost the eye.\n"
    "  3. Film the visible LED and, through the other lens, the patch in one picture, at 240 fps "
    "or\n"
    "     more. Lock focus and exposure. Expose as long as the rate allows, so that no pulse of "
    "the\n"
    "     display falls between two frames, but not so long that LED or patch become pure white.\n"
    "     Have LED and patch at one height of the picture: cameras take its rows one by one.\n"
    "  4. Switch the lamp on for a second and off for one to two seconds, unevenly, 20 times or "
    "more.\n"
    "     Shorter is taken for a blink. Blinks flip the patch too: they are told from the lamp by\n"
    "     their length here, and in the video because no LED goes with them.\n"
    "  5. Take the video apart, no frame left out or twice:\n"
    "       ffmpeg -i VIDEO -fps_mode passthrough FRAMES/%06d.png\n"
    "  6. Find LED and patch in a frame, as X,Y,W,H in pixels, and measure:\n"
    "       gazeloop probe --video FRAMES --camera-fps 240 --lamp X,Y,W,H --patch X,Y,W,H\n"
    "                      --json RESULT.json\n"
    "     The rate is the one at which the camera took the frames, not the one it plays them at.\n"
    "  7. gazeloop report SESSION --probe RESULT.json shows it beside what the session says.\n";

}  // namespace gazeloop::probe

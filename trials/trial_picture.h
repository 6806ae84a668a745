// What was found in a frame, drawn into a picture of it for people.
#pragma once

#include "core/image_file.h"
#include "trials/trial.h"

namespace fathom {

/// The cups that stand there are outlined, green when found and red when missed; blue are the circles of what was taken
/// for a cup, 45 mm above the desk and at the rim. `picture` shows the frame so many times side by side in its upper
/// left.
void draw_trial(const LabelledFrame& frame, const Trial& trial, int panels, Image<Rgb>& picture);

}  // namespace fathom

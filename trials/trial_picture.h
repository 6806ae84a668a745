// What was found in a frame, drawn into a picture of it for people.
#pragma once

#include "core/image_file.h"
#include "trials/trial.h"

namespace fathom {

/// Draws into `picture`, which shows the frame `panels` times side by side from its upper left corner. In each of them
/// the cups that stand there get outlines, green when found and red when missed, and all that was taken for a cup gets
/// two blue circles, 45 mm above the desk and at the rim.
void draw_trial(const LabelledFrame& frame, const Trial& trial, int panels, Image<Rgb>& picture);

}  // namespace fathom

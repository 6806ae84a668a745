// A random desk and what was found on it as a picture for people.
#pragma once

#include "core/image_file.h"
#include "trials/clutter_trial.h"

namespace fathom {

/// As preview(). In its upper panels the cups that stand there are outlined, green when found and red when missed; blue
/// are the circles of what was taken for a cup, 45 mm above the desk and at the rim.
Image<Rgb> trial_picture(const TrialShot& shot, const Trial& trial);

}  // namespace fathom

// Dots that a projector throws on a desk and on the bottom of a cup with water, by POV-Ray's photon map.
//
// parameters.inc, beside this file, declares: CameraMm, ProjectorMm, and Right, Down, Forward of both; FocalPx, Columns and
// Rows of the image; SlideLeft, SlideTop, SlideColumns, SlideRows: where slide.png lies in the projector's image plane, in
// units of the focal length; BottomDots, where in it those dots are that fall on the bottom; DotSigma of every dot, in units
// of the focal length; DistanceMm of the cup; FillMm and Index of the water; DeskAlbedo, CupAlbedo; Photons, how many are
// sent through the dots on the bottom.
//
// Coordinates are those of the world, z up; what is handed over says left and right, so it matters nowhere that this frame
// is right-handed and POV-Ray's is not.
#version 3.7;
#include "parameters.inc"

// The paper's cup.
#declare RimMm = 87;
#declare BottomMm = 7;
#declare InnerMm = 40;
#declare OuterMm = 43;

global_settings {
  assumed_gamma 1
  max_trace_level 8
  photons { count Photons }
}
#default { finish { ambient 0 diffuse 1 } }

camera {
  perspective
  location CameraMm
  direction FocalPx * Forward
  right Columns * Right
  up -Rows * Down
}

// 2 / (1 + (d / fade_distance)²): the inverse square, to a millionth. On a white surface at 1 m a dot's centre is 1.
light_source {
  ProjectorMm, rgb 1e6 / 2
  fade_distance 1
  fade_power 2
}

// The slide, 10 mm from the light, in the unit square with y up, as POV-Ray lays pictures. Photons come through what
// they are aimed at alone: a window in it for each dot on the bottom. The others light the desk as light does.
#declare SlideMm = 10;
#declare Corner = ProjectorMm + SlideMm * (Forward + SlideLeft * Right + (SlideTop + SlideRows) * Down);
#declare Across = SlideMm * SlideColumns * Right;
#declare Up = -SlideMm * SlideRows * Down;
#declare HalfWindow = 4 * DotSigma * <1 / SlideColumns, 1 / SlideRows>;
#declare Windows = dimension_size(BottomDots, 1);
#macro Rectangle(First, Last)
  First, <Last.u, First.v>, Last, <First.u, Last.v>, First
#end
#macro Window(I)
  Rectangle(BottomDots[I] - HalfWindow, BottomDots[I] + HalfWindow)
#end
#declare Picture = texture {
  pigment { image_map { png "slide.png" gamma 1 interpolate 2 once filter all 1 } }
  finish { diffuse 0 }
}
#declare InPlace = transform {
  matrix <Across.x, Across.y, Across.z, Up.x, Up.y, Up.z, Forward.x, Forward.y, Forward.z, Corner.x, Corner.y, Corner.z>
}
polygon {
  5 * (1 + Windows), Rectangle(<0, 0>, <1, 1>)
  #for (I, 0, Windows - 1)
    , Window(I)
  #end
  texture { Picture }
  transform { InPlace }
  no_image
}
#for (I, 0, Windows - 1)
  polygon {
    5, Window(I)
    texture { Picture }
    transform { InPlace }
    interior { ior 1 }
    photons { target refraction on reflection off }
  }
#end
polygon {
  10, Rectangle(<-20, -20>, <21, 21>), Rectangle(<0.001, 0.001>, <0.999, 0.999>)
  pigment { rgb 0 }
  transform { InPlace }
  no_image
}

plane { z, 0 pigment { rgb DeskAlbedo } photons { collect off } }
union {
  cylinder { <0, 0, BottomMm>, <0, 0, RimMm>, InnerMm open }
  disc { <0, 0, BottomMm>, z, InnerMm }
  cylinder { <0, 0, 0>, <0, 0, RimMm>, OuterMm open }
  disc { <0, 0, RimMm>, z, OuterMm, InnerMm }
  translate DistanceMm * y
  pigment { rgb CupAlbedo }
}

// The water reaches half-way into bottom and wall.
cylinder {
  <0, 0, BottomMm / 2>, <0, 0, BottomMm + FillMm>, (InnerMm + OuterMm) / 2
  translate DistanceMm * y
  pigment { rgbt 1 }
  finish { diffuse 0 reflection { 0, 1 fresnel } conserve_energy }
  interior { ior Index }
  photons { refraction on reflection off }
}

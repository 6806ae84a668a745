// Where the light of each pixel of an eye comes from: the first diffuse point, found through the liquid by POV-Ray's own
// rays, as a colour: red, green, blue are x, y, z [mm] within the box from Least to Most.
//
// parameters.inc, beside this file, declares: EyeMm, and Right, Down, Forward of it; FocalPx, Columns and Rows of the image;
// Least, Most; HasCup, and with a cup CupMm, its foot; RimMm, BottomMm, InnerMm, OuterMm; SagMm, by how much the middle of
// its bottom is lower than the edge; Bumps, objects that lie in it: x, y, z of the middle [mm, from CupMm] and the radius;
// LevelMm of the liquid above the desk, 0 without one; Index of the liquid, 0 where it is as opaque as paint; TiltDeg and
// AzimuthDeg of its surface; RiseMm, by how much it climbs the wall, and CapillaryMm, within which that falls to 1/e.
//
// Coordinates are those of the world, z up; what is handed over says left and right, so it matters nowhere that this frame
// is right-handed and POV-Ray's is not.
#version 3.7;
#include "parameters.inc"

global_settings { assumed_gamma 1 max_trace_level 8 }
camera {
  perspective
  location EyeMm
  direction FocalPx * Forward
  right Columns * Right
  up -Rows * Down
}

// Three pigments in equal parts: each stands for three times its share. A function takes numbers, not parts of vectors.
#declare Lx = Least.x; #declare Ly = Least.y; #declare Lz = Least.z;
#declare Sx = Most.x - Least.x; #declare Sy = Most.y - Least.y; #declare Sz = Most.z - Least.z;
#declare Position = texture {
  pigment {
    average
    pigment_map {
      [1 function { (x - Lx) / Sx } color_map { [0 rgb 0] [1 rgb <3, 0, 0>] }]
      [1 function { (y - Ly) / Sy } color_map { [0 rgb 0] [1 rgb <0, 3, 0>] }]
      [1 function { (z - Lz) / Sz } color_map { [0 rgb 0] [1 rgb <0, 0, 3>] }]
    }
  }
  finish { ambient 0 diffuse 0 emission 1 }
}

plane { z, 0 texture { Position } }

#if (HasCup)
  #declare MiddleMm = (InnerMm + OuterMm) / 2;
  // A bowl that meets the wall at the bottom's edge; its sphere's radius follows from sag and edge.
  #if (SagMm > 0)
    #declare BowlMm = (InnerMm * InnerMm + SagMm * SagMm) / (2 * SagMm);
  #end
  object {
    difference {
      cylinder { <0, 0, 0>, <0, 0, RimMm>, OuterMm }
      cylinder { <0, 0, BottomMm>, <0, 0, RimMm + 1>, InnerMm }
      #if (SagMm > 0)
        intersection {
          sphere { <0, 0, BottomMm - SagMm + BowlMm>, BowlMm }
          cylinder { <0, 0, 0>, <0, 0, RimMm>, InnerMm }
        }
      #end
    }
    translate CupMm
    texture { Position }
  }
  #for (I, 0, dimension_size(Bumps, 1) - 1)
    sphere { <Bumps[I].x, Bumps[I].y, Bumps[I].z>, Bumps[I].t translate CupMm texture { Position } }
  #end
  #if (LevelMm > 0)
    #if (RiseMm > 0)
      // A solid of revolution about y: down the axis, out, up the wall's middle, and back along the surface.
      #declare Steps = 100;
      #declare Flat = lathe {
        linear_spline Steps + 5,
        <0, -200>, <OuterMm + 5, -200>, <OuterMm + 5, RiseMm>
        #for (I, 0, Steps)
          , <InnerMm * (1 - I / Steps), RiseMm * exp(-InnerMm * I / Steps / CapillaryMm)>
        #end
        , <0, -200>
        rotate 90 * x
      };
    #else
      #declare Flat = plane { z, 0 };
    #end
    #declare Surface = object { Flat rotate TiltDeg * y rotate AzimuthDeg * z translate LevelMm * z };
    // The liquid reaches half-way into bottom and wall.
    object {
      intersection {
        cylinder { <0, 0, BottomMm / 2>, <0, 0, RimMm + 20>, MiddleMm }
        object { Surface }
      }
      translate CupMm
      #if (Index > 0)
        pigment { rgbt 1 }
        finish { ambient 0 diffuse 0 specular 0 reflection 0 }
        interior { ior Index }
      #else
        texture { Position }
      #end
    }
  #end
#end

// The first diffuse point that each pixel sees through a liquid in a cup, found by POV-Ray's own primitives.
//
// parameters.inc, beside this file, declares: HeightMm of the sensor, which aims at the cup's foot; DistanceMm of the cup;
// LevelMm of the liquid above the desk; Index of the liquid; FirstColumn, LastColumn, FirstRow, LastRow. The surface is
// a meniscus with ContactAngleDeg and CapillaryLengthMm, spun with CurvaturePerMm, or a plane with TiltDeg, TiltAzimuthDeg.
// Writes points.txt: of each pixel whose light crosses the surface its column and row, the point x, y, z [mm], and the
// unit direction in which the last ray came there.
//
// Coordinates are those of the world, z up. That this frame is right-handed and POV-Ray's is not makes no difference to
// the formulas of vcross and rotate, only to how a picture would look.
#version 3.7;
#include "parameters.inc"

// ASUS Xtion PRO LIVE, the paper's cup.
#declare BaselineMm = 75;
#declare FocalPx = 1200 / (2 * 1.052);
#declare RimMm = 87;
#declare BottomMm = 7;
#declare InnerMm = 40;
#declare OuterMm = 43;

#declare Camera = <-BaselineMm / 2, 0, HeightMm>;
#declare Forward = vnormalize(<0, DistanceMm, -HeightMm>);
#declare Right = x;
#declare Down = vcross(Forward, Right);

#declare Cup = union {
  cylinder { <0, 0, BottomMm>, <0, 0, RimMm>, InnerMm open }
  disc { <0, 0, BottomMm>, z, InnerMm }
  cylinder { <0, 0, 0>, <0, 0, RimMm>, OuterMm open }
  disc { <0, 0, RimMm>, z, OuterMm, InnerMm }
  translate DistanceMm * y
}

#ifdef (ContactAngleDeg)
  // Young-Laplace at a plane wall, bent around the axis: with height z and u = acosh(2 l / z),
  // distance from the wall / l = u - 2 tanh(u) + constant. Points evenly in u from the wall to the axis, where
  // tanh(u) = 1 to 1e-12. The spline wants one more at each end: behind the wall and once more on the axis. Its slope
  // between points is off by the square of their distance.
  #declare Pieces = 800;
  #declare AtWall = acosh(1 / sin(radians(90 - ContactAngleDeg) / 2));
  #declare FromWall = function(u) { CapillaryLengthMm * (u - AtWall - 2 * (tanh(u) - tanh(AtWall))) }
  #declare AtAxis = InnerMm / CapillaryLengthMm + AtWall + 2 * (1 - tanh(AtWall));
  #declare Top = lathe {
    cubic_spline Pieces + 3
    #for (I, -1, Pieces + 1)
      #local U = AtWall + (AtAxis - AtWall) * I / Pieces;
      , <max(0, InnerMm - FromWall(U)), 2 * CapillaryLengthMm / cosh(U)>
    #end
    sturm
    rotate 90 * x  // from POV-Ray's axis, y
    translate LevelMm * z
  }
#else
  #ifdef (CurvaturePerMm)
    #declare Top = quadric {
      <CurvaturePerMm / 2, CurvaturePerMm / 2, 0>, <0, 0, 0>, <0, 0, -1>, LevelMm
    }
  #else
    #declare Top = plane { z, 0 rotate -TiltDeg * y rotate TiltAzimuthDeg * z translate LevelMm * z }
  #end
  #declare Top = object { Top clipped_by { cylinder { <0, 0, 0>, <0, 0, RimMm>, (InnerMm + OuterMm) / 2 } } }
#end
#declare Top = object { Top translate DistanceMm * y }

#declare BehindMm = 1e-3;  // where a ray that was bent starts again: clear of the surface that it left

#fopen Out "points.txt" write
#for (Row, FirstRow, LastRow)
  #for (Column, FirstColumn, LastColumn)
    #local Start = Camera;
    #local Direction = vnormalize((Column + 0.5 - 320) / FocalPx * Right + (Row + 0.5 - 240) / FocalPx * Down + Forward);
    #local Inside = 0;
    #local Crossings = 0;
    #local Going = 1;
    #while (Going)
      #local CupNormal = <0, 0, 0>;
      #local Normal = <0, 0, 0>;
      #local OnCup = trace(Cup, Start, Direction, CupNormal);
      #local OnTop = trace(Top, Start, Direction, Normal);
      #local MeetsCup = (vlength(CupNormal) > 0);
      #local MeetsTop = (vlength(Normal) > 0);
      #if (MeetsTop & MeetsCup)
        #local MeetsTop = (vlength(OnTop - Start) < vlength(OnCup - Start));
      #end
      #if (MeetsTop)
        #local N = vnormalize(Normal);
        #if (vdot(N, Direction) > 0)
          #local N = -N;
        #end
        // Snell's law; where it has no solution the light is totally reflected.
        #local Ratio = (Inside ? Index : 1 / Index);
        #local Cosine = -vdot(N, Direction);
        #local SquaredCosine = 1 - Ratio * Ratio * (1 - Cosine * Cosine);
        #if (SquaredCosine < 0)
          #local Direction = Direction + 2 * Cosine * N;
        #else
          #local Direction = vnormalize(Ratio * Direction + (Ratio * Cosine - sqrt(SquaredCosine)) * N);
          #local Inside = 1 - Inside;
        #end
        #local Start = OnTop + BehindMm * Direction;
        #local Crossings = Crossings + 1;
        #local Going = (Crossings < 8);
      #else
        #if (MeetsCup & (Crossings > 0))
          #write (Out, Column, " ", Row, " ", vstr(3, OnCup, " ", 0, 12), " ", vstr(3, Direction, " ", 0, 15), "\n")
        #end
        #local Going = 0;
      #end
    #end
  #end
#end
#fclose Out

// Every command of the program, in the order of `fathom --help`.
#pragma once

#include <array>

#include "app/command.h"

namespace fathom {

Define define_capture, define_export, define_theory, define_detect, define_evaluate, define_campaign, define_generate,
    define_check, define_measure, define_calibrate, define_diagnose, define_view, define_reproduce, define_template,
    define_verify, define_list, define_manual;

inline constexpr std::array kCommands{
    Command{"capture", "One simulated shot of a scene (or several): infrared image, disparity, depth, cloud, truth",
            "  fathom capture scenes/paper_water.json -o out/water\n"
            "  fathom capture scenes/paper_water.json --mode geometric -o out/exact\n"
            "  fathom capture scenes/paper_milk_tea.json -o out/milk_tea\n"
            "  fathom capture scenes/glass_water.json -o out/glass",
            define_capture, kNeedsOutput},
    Command{"export", "A scene as glTF 2.0 for Blender and others, or one of its cups as a shape for other scenes",
            "  fathom export scenes/glass_water.json -o out/glass.glb\n"
            "  fathom export scenes/glass_water.json --cup 0 -o out/tumbler.glb",
            define_export, kNeedsOutput, "FILE"},
    Command{"theory", "The paper's Eq. 7 and the exact triangulation of the raised bottom, as CSV",
            "  fathom theory\n  fathom theory --fill-mm 30 --distance-mm 200,400,600 --lateral-mm 50 -o out/theory\n"
            "  fathom theory --max-skew",
            define_theory},
    Command{"detect",
            "Finds cups on a desk and the liquids in them, in measured or simulated clouds or before a depth camera",
            "  fathom detect out/water/cloud.pcd\n"
            "  fathom detect out/water/cloud.pcd --height-mm 650 --pitch-deg 58.4 --json\n"
            "  fathom detect shot1.pcd shot2.ply --config detector.json -o out/detected\n"
            "  fathom detect left.pcd right.pcd --poses poses.json\n"
            "  fathom detect --live scenes/paper_water.json --frames 3\n  fathom detect --live --frames 10",
            define_detect},
    Command{"evaluate",
            "Detection rates over random desks, a data set, or a folder of clouds whose containers are labelled",
            "  fathom evaluate recognition --trials 20 -o out/recognition\n"
            "  fathom evaluate liquid --method paper --trials 1 -o out/table1\n"
            "  fathom evaluate out/frames -o out/card\n"
            "  fathom evaluate mOSD --method paper -o out/paper",
            define_evaluate},
    Command{"campaign", "A simulated measurement campaign, in the files that a laboratory with a sensor writes",
            "  fathom campaign scenes/campaigns/paper.json -o out/paper\n"
            "  fathom campaign scenes/campaigns/paper.json -o out/paper --seed 2 --truth out/paper_truth.json",
            define_campaign, kNeedsOutput},
    Command{"generate", "Labelled frames of random desks by the thousand, as BOP and COCO have them",
            "  fathom generate --frames 20 -o out/frames\n  fathom generate --example\n"
            "  fathom generate scenes/datasets/cups.json --frames 1000 --shard 0/4 -o out/frames",
            define_generate},
    Command{"check",
            "Lists in seconds what a measurement directory holds and lacks, and what each lack means for a diagnosis",
            "  fathom check out/paper\n  fathom check scenes/measurements/paper_printed\n"
            "  fathom check --example -o out/laboratory\n  fathom check out/paper --json -o out/checked",
            define_check},
    Command{"measure",
            "Fills the height columns of a measurement directory: writes heights.csv there, or to the folder of -o",
            "  fathom measure out/paper\n  fathom measure out/paper -o out/heights", define_measure},
    Command{"calibrate", "Learns how one device differs from its model, from clouds of desks and walls: unit.json",
            "  fathom calibrate out/water/cloud.pcd -o out/unit\n"
            "  fathom calibrate out/paper/frames.csv --height-mm 650 --pitch-deg 58.4 -o out/unit",
            define_calibrate, kNeedsOutput},
    Command{"diagnose",
            "Finds where model and measurement disagree, names the effect that explains it, and what is left",
            "  fathom diagnose out/paper -o out/diagnosis\n"
            "  fathom diagnose out/paper --model out/diagnosis/model.json -o out/rest\n"
            "  fathom diagnose out/paper --fidelity photometric -o out/traced",
            define_diagnose, kNeedsOutput},
    Command{"view", "A capture, a detection or a diagnosis as a page for a browser, on which it can be turned",
            "  fathom view out/water\n  fathom view out/glass -o out/glass.html\n"
            "  fathom view out/detected\n  fathom view out/diagnosis",
            define_view, false, "FILE"},
    Command{"reproduce", "The paper's figures, simulated beside printed: data, pictures and report.html",
            "  fathom reproduce fig10 fig12 fig13 -o out/theory\n  fathom reproduce fig5 fig14 --trials 10 -o "
            "out/paper_figures",
            define_reproduce, kNeedsOutput},
    Command{"template", "Makes a cup template for detect from a cloud of one empty cup",
            "  fathom template cloud.pcd -o templates --name my_mug\n"
            "  fathom template cloud.pcd -o templates --name tall_mug --liquid-threshold-mm 6",
            define_template, kNeedsOutput},
    Command{"verify", "Certification of light transport against published tables: value, standard error, verdict",
            "  fathom verify all\n"
            "  fathom verify slab --index 1.336 --absorption-per-mm 0.0032 --scattering-per-mm 3.3 --anisotropy 0.85 "
            "--thickness-mm 10\n"
            "  fathom verify slab --index 1 --absorption-per-mm 0.01 --scattering-per-mm 0.99 --anisotropy 0 "
            "--thickness-mm inf --json\n"
            "  fathom verify fresnel --from 1 --to 1.328 --angle-deg 60",
            define_verify},
    Command{"list", "The libraries of media, cups, sensors and effects, with units and sources",
            "  fathom list media\n  fathom list cups --json", define_list},
    Command{"manual", "Man pages, and completions for bash, zsh and fish, as they lie below ~/.local/share",
            "  fathom manual -o out/share", define_manual, kNeedsOutput},
};

}  // namespace fathom

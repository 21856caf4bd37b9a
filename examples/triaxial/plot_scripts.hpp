// SPDX-License-Identifier: MIT
// The gnuplot scripts of the figures; @NAME@ is filled in by plots.cpp.
#pragma once

#include <string_view>

namespace triaxial {

// clang-format off
inline constexpr std::string_view style_script = R"gp(# Look of all figures. A figure script sets `kind` (svg or png), `w` and `h` (points) and loads this file.
reset
if (kind eq "svg") {
    set terminal svg size w,h font "DejaVu Sans,13" linewidth 1.1 background rgb "white" standalone
} else {
    set terminal pngcairo size 2*w,2*h font "DejaVu Sans,13" fontscale 1.6 linewidth 2.2 pointscale 2 background rgb "white"
}
set encoding utf8
set border 3 linecolor rgb "#404040" linewidth 1
set tics out nomirror scale 0.6 textcolor rgb "#404040"
set grid linecolor rgb "#e4e4e4" linewidth 0.8 linetype 1
set key top left Left reverse samplen 2 spacing 1.25 textcolor rgb "#303030" nobox noenhanced
set datafile separator comma
blue = "#0072b2"; red = "#d55e00"; green = "#009e73"; grey = "#707070"; dark = "#303030"
)gp";

/// The script of a curve of series.csv.
inline constexpr std::string_view curve_script = R"gp(# @TITLE@. Redraw: gnuplot @FIGURE@.gp
wanted(s) = @WANTED@
do for [kind in "svg png"] {
    w = 640; h = 460
    load "style.gp"
    set datafile columnheaders
    set output "@FIGURE@.".kind
@BODY@    unset output
}
)gp";

/// What such a curve fills in.
struct curve_figure {
    std::string_view name; ///< of its files
    std::string_view title;
    std::string_view body; ///< axes and curves
};

inline constexpr curve_figure stress_figure{
    "stress", "Deviatoric stress against axial strain, from series.csv",
    R"gp(    set xlabel "axial strain ε_a  (%)"
    set ylabel "deviatoric stress q = σ_1 − σ_3  (MPa)"
    set xrange [@EMIN@:@EMAX@]
    set yrange [@QMIN@:@QTOP@]
    set label 1 sprintf("peak %.2f MPa at %.1f %%", @QPEAK@, @EPEAK@) at @EPEAK@, @QPEAK@ point pointtype 7 pointsize 0.6 linecolor rgb red offset character @LABEL_X@, 0.9 @LABEL_SIDE@ textcolor rgb red front noenhanced
    plot "@SERIES@" using (wanted(strcol("stage")) ? 100*column("axial_strain") : NaN):(column("q_Pa")/1e6) with lines linewidth 1.8 linecolor rgb blue notitle
)gp"};

inline constexpr curve_figure volume_figure{
    "volume", "Volumetric strain against axial strain, dilation positive (series.csv has compression positive)",
    R"gp(    set xlabel "axial strain ε_a  (%)"
    set ylabel "volumetric strain, dilation positive  (%)"
    set xrange [@EMIN@:@EMAX@]
    set arrow 1 from graph 0, first 0 to graph 1, first 0 nohead linecolor rgb grey linewidth 0.9 dashtype 3 back
    set label 1 "dilation" at graph 0.985, first 0 right offset 0, 0.7 textcolor rgb grey font ",11"
    set label 2 "contraction" at graph 0.985, first 0 right offset 0, -0.7 textcolor rgb grey font ",11"
    set yrange [@VMIN@:@VMAX@]
    plot "@SERIES@" using (wanted(strcol("stage")) ? 100*column("axial_strain") : NaN):(-100*column("volumetric_strain")) with lines linewidth 1.8 linecolor rgb blue notitle
)gp"};

inline constexpr curve_figure fractures_figure{
    "fractures", "Broken bonds and replaced clumps, cumulative, from series.csv",
    R"gp(    set xlabel "axial strain ε_a  (%)"
    set ylabel "count since the start of the test"
    set xrange [@EMIN@:@EMAX@]
    set yrange [0:@TOP@]
    plot "@SERIES@" using (wanted(strcol("stage")) ? 100*column("axial_strain") : NaN):(column("broken_tension")+column("broken_shear")) with steps linewidth 2.2 linecolor rgb dark title "all broken bonds", \
         "" using (wanted(strcol("stage")) ? 100*column("axial_strain") : NaN):(column("broken_tension")) with steps linewidth 1.6 linecolor rgb blue title "in tension", \
         "" using (wanted(strcol("stage")) ? 100*column("axial_strain") : NaN):(column("broken_shear")) with steps linewidth 1.6 linecolor rgb red title "in shear", \
         "" using (wanted(strcol("stage")) ? 100*column("axial_strain") : NaN):(column("replaced")) with steps linewidth 2.2 linecolor rgb green title "replaced grains"
)gp"};

inline constexpr curve_figure compression_figure{
    "compression", "Void ratio against mean stress, from series.csv",
    R"gp(    set xlabel "mean stress p'  (kPa)"
    set ylabel "void ratio e"
    set logscale x
    set xrange [1:*]
    plot "@SERIES@" using (wanted(strcol("stage")) && column("p_Pa") >= 1e3 ? column("p_Pa")/1e3 : NaN):(column("void_ratio")) with lines linewidth 1.8 linecolor rgb blue notitle
)gp"};

inline constexpr std::string_view membrane_script = R"gp(# Shape of the membrane at the start and at the end of shear. Redraw: gnuplot membrane.gp
# data/membrane_*.csv: x_cm,z_cm; left: radius over height, band from the smallest to the largest radius of a ring
do for [kind in "svg png"] {
    w = 760; h = 580
    load "style.gp"
    set output "membrane.".kind
    set multiplot
    set lmargin at screen 0.085
    set rmargin at screen 0.47
    set tmargin at screen 0.89
    set bmargin at screen 0.15
    set style fill solid 0.25 noborder
    set xlabel "distance of the membrane from the axis  (cm)\nline: mean of a ring; band: its smallest to its largest"
    set ylabel "height  (cm)"
    set xrange [@R0@:@R1@]
    set yrange [@Z0@:@Z1@]
    set key at screen 0.085, 0.985 left top vertical Left reverse samplen 1.6 spacing 1.2 enhanced
    plot @BANDS@
    unset key; unset label
    set lmargin at screen 0.58
    set rmargin at screen 0.97
    set xlabel "x  (cm)"
    unset ylabel
    set xrange [-@HALF@:@HALF@]
    set size ratio -1
    set label 1 "outline seen along y" at screen 0.775, 0.962 center textcolor rgb dark font ",13"
    plot @OUTLINES@
    unset multiplot
    unset output
}
)gp";

inline constexpr std::string_view rosette_script = R"gp(# Azimuths of the fractures in sectors of 10 degrees, from events.csv. Redraw: gnuplot rosette.gp
# data/rosette_*.csv: the sectors as polygons; the radius of a sector is its count
do for [kind in "svg png"] {
    w = 560; h = 600
    load "style.gp"
    set output "rosette.".kind
    unset border; unset tics; unset grid
    set size ratio -1
    set lmargin at screen 0.08; set rmargin at screen 0.92
    set bmargin at screen 0.07; set tmargin at screen 0.89
    set xrange [-@REACH@:@REACH@]
    set yrange [-@REACH@:@REACH@]
    set key at screen 0.5, 0.97 center center horizontal samplen 1 width 2 maxrows 1
    set label 100 "fractures per sector of 10°, by the azimuth of their position" at screen 0.5, 0.052 center textcolor rgb grey font ",11"
    set label 101 "@CAPTION@" at screen 0.5, 0.022 center textcolor rgb grey font ",11"
    @CIRCLES@
    plot "data/rosette_rings.csv" using 1:2 with lines linewidth 0.8 linecolor rgb "#d0d0d0" notitle, \
         "data/rosette_tension.csv" using 1:2 with filledcurves closed fillstyle solid 0.9 border linecolor rgb "white" fillcolor rgb blue title "tension", \
         "data/rosette_shear.csv" using 1:2 with filledcurves closed fillstyle solid 0.9 border linecolor rgb "white" fillcolor rgb red title "shear"
    unset output
}
)gp";

inline constexpr std::string_view specimen_script = R"gp(# The specimen seen along y. Redraw: gnuplot specimen.gp
# data/specimen_*.rgb: raster pictures, rows from the bottom, 3 bytes per pixel; data/outline_*.csv: the membrane
do for [kind in "svg png"] {
    w = @W@; h = @H@
    load "style.gp"
    set output "specimen.".kind
    unset border; unset tics; unset grid
    set multiplot
    unset key
@PANELS@
@LEGEND@
    unset multiplot
    unset output
}
)gp";

inline constexpr std::string_view section_script = R"gp(# Cut through the specimen, as in Fig. 16 of the paper. Redraw: gnuplot section.gp
# data/section_*.csv: circles x_cm,y_cm,radius_cm,colour in drawing order; data/section_*_wall.csv: the membrane
do for [kind in "svg png"] {
    w = @W@; h = @H@
    load "style.gp"
    set output "section.".kind
    unset border; unset tics; unset grid
    set style fill solid 1.0 noborder
    set multiplot
    unset key
@PANELS@
@LEGEND@
    unset multiplot
    unset output
}
)gp";

// clang-format on

} // namespace triaxial

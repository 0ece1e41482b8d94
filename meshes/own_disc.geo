// A disc below a pin: radii 20 and 80 mm, 8 mm thick, its upper face in z = 0. The patch where the pin slides, 24 x 16 mm
// about x = 65 mm, is a face of its own, as CAD programs imprint it. In mm; own_disc.step is written by
//     gmsh -0 own_disc.geo
SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, -8, 0, 0, 8, 80};
Cylinder(2) = {0, 0, -8, 0, 0, 8, 20};
BooleanDifference{ Volume{1}; Delete; }{ Volume{2}; Delete; }
Rectangle(100) = {53, -8, 0, 24, 16};
BooleanFragments{ Volume{1}; Delete; }{ Surface{100}; Delete; }
Save "own_disc.step";

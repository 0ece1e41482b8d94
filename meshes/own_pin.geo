// A pin that presses on a disc: its square foot, 10 x 10 mm, lies in z = 0. In mm; own_pin.step is written by
//     gmsh -0 own_pin.geo
SetFactory("OpenCASCADE");
Box(1) = {-5, -5, 0, 10, 10, 10};
Box(2) = {-4, -4, 10, 8, 8, 30};
BooleanUnion{ Volume{1}; Delete; }{ Volume{2}; Delete; }
Save "own_pin.step";

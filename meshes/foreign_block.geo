// A block as somebody else might bring it: mm, own names of the groups, origin in a corner.
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 60, 40, 20};
Transfinite Curve {:} = 6;
Transfinite Surface {:};
Recombine Surface {:};
Transfinite Volume {:};
Physical Surface("Lauffläche") = {6};
Physical Surface("Einspannung") = {5};
Physical Volume("Stahl") = {1};

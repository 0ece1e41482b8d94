// A link of second-order tetrahedra as a mesher writes it: mm, named faces, finer where something will press on it.
//
//     z                 + contact point 30, 15, 12
//     |   __________________________________
//     |  |   |   |                  |   |   |
//     +--|___|___|__________________|___|___|-- x      60 x 30 x 12, two bores of radius 4, held
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 60, 30, 12};
Cylinder(2) = {8, 15, -1, 0, 0, 14, 4};
Cylinder(3) = {52, 15, -1, 0, 0, 14, 4};
BooleanDifference(4) = { Volume{1}; Delete; }{ Volume{2, 3}; Delete; };
Physical Volume("steel") = {4};
Physical Surface("bores") = {Surface In BoundingBox {3, 10, -1, 13, 20, 13}, Surface In BoundingBox {47, 10, -1, 57, 20, 13}};
Physical Surface("top") = Surface In BoundingBox {-1, -1, 11, 61, 31, 13};
Field[1] = Ball;
Field[1].XCenter = 30;
Field[1].YCenter = 15;
Field[1].ZCenter = 12;
Field[1].Radius = 11;
Field[1].Thickness = 8;
Field[1].VIn = 2.7;
Field[1].VOut = 9;
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromCurvature = 12;
Mesh.ElementOrder = 2;
Mesh.HighOrderOptimize = 2;

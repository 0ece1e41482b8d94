SetFactory("OpenCASCADE");
Box(1) = {0,0,0,1,1,1}; Box(2) = {1,0,0,1,1,1};
BooleanFragments{ Volume{1,2}; Delete; }{}
Transfinite Curve{:} = 3;
s() = Boundary{ Volume{1}; };
Transfinite Surface{s()}; Recombine Surface{s()}; Transfinite Volume{1};
f() = Surface In BoundingBox{-0.01,-0.01,-0.01,0.01,1.01,1.01};
Physical Surface("left") = {f()};
Physical Volume("body") = {1,2};
Mesh.MeshSizeMax = 0.5;

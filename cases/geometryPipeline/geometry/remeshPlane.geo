// The deformed body in plane strain, from the loop that extractSurface wrote (a hole would be another curve: {1}, {2}).
//     gmsh -2 remeshPlane.geo -o deformed.msh
Merge "surface.msh";
Curve Loop(1) = {1};
Plane Surface(1) = {1};
Physical Surface("sand") = {1};

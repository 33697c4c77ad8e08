// The deformed body: a volume mesh inside the surface that extractSurface wrote. Its triangles stay as they are.
//     gmsh -3 remesh.geo -o deformed.msh
Merge "surface.msh";
Surface Loop(1) = {1};
Volume(1) = {1};
Physical Volume("sand") = {1};

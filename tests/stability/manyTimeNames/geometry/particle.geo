// A square as wide as one particle.
SetFactory("OpenCASCADE");
Rectangle(1) = {3, 3, 0, 0.25, 0.25};
Physical Surface("solid") = {1};

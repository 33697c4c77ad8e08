// The second alone.
SetFactory("OpenCASCADE");
Rectangle(1) = {2002.25, 0.75, 0, 1.5, 1};
Physical Surface("far") = {1};

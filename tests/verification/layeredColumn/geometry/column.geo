// Three layers of 2 m, half a metre wide.
width = 0.5;
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, width, 2};
Rectangle(2) = {0, 2, 0, width, 2};
Rectangle(3) = {0, 4, 0, width, 2};
Coherence;
Physical Surface("below") = {1};
Physical Surface("middle") = {2};
Physical Surface("above") = {3};

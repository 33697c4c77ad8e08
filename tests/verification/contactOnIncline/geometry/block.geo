// A flat block on a plane of particles, whose surface is y = 0.
SetFactory("OpenCASCADE");
Rectangle(1) = {0.5, 0, 0, 2, 0.25};
Rectangle(2) = {0, -0.25, 0, 4, 0.25};
Physical Surface("block") = {1};
Physical Surface("plane") = {2};

// Two discs of radius 0.2 m on the diagonal of the unit square. Lengths in metres.
SetFactory("OpenCASCADE");
Disk(1) = {0.2, 0.2, 0, 0.2};
Disk(2) = {0.8, 0.8, 0, 0.2};
Physical Surface("lower") = {1};
Physical Surface("upper") = {2};

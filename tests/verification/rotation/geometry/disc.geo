SetFactory("OpenCASCADE");
Disk(1) = {0, 0, 0, 1};
Physical Surface("disc") = {1};

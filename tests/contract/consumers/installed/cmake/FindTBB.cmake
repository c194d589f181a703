# A module as older projects have it: variables and no target.
set(TBB_FOUND TRUE)
set(TBB_LIBRARIES tbb)

"""What else tells how much light arrives: rays through Embree, Mitsuba 3, numpy by brute force."""

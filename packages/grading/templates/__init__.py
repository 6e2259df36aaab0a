"""Files to begin with, one for each subject: `reftrace judge --template` copies one."""

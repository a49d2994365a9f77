# outliner

export const LINES = {
    motion: /^\s*(?:E?I?MOV[A-Z]*|REFP|SMOV[A-Z]*)\b/i,
    opens: /^\s*(?:IFTHENEXP|IFTHEN|FOR|WHILEEXP|WHILE|SWITCH)\b/i,
    parts: /^\s*(?:ELSE|ELSEIF|ELSEIFEXP|CASE|DEFAULT)\b/i,
    closes: /^\s*(?:ENDIF|NEXT|ENDWHILE|ENDSWITCH)\b/i,
    // ///NPOS counts what stands below it, which is less when something is left out.
    keeps: /^\s*(?:\/{1,4}(?!\/\/NPOS|\/NPOS)[A-Z]+|NOP\s*$|END\s*$)/i,
};
